// SPDX-License-Identifier: BSD-3-Clause
// The JSON library, included the same way everywhere.
//
// Its parser asserts that strtod read the whole of a number, which fails where the locale's decimal point has
// several bytes. That number is not used here (json_text.cpp), so neither is the assertion; its other ones
// state what this folder checks beforehand.
#pragma once

#define JSON_ASSERT(condition) static_cast<void>(0)
#include <nlohmann/json.hpp>
