// SPDX-License-Identifier: BSD-3-Clause
// Is the master surface of a scene admissible? ents_surface_check, printed.
#pragma once

#include "contact.hpp"

namespace host {

/// @return exit code: 1 if a condition is violated
int check_surface(const Contact& contact, const std::string& unit_of_length);

} // namespace host
