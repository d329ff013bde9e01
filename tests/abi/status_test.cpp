// SPDX-License-Identifier: BSD-3-Clause
// Status values are pinned for ever, and every one of them has a text.
#include <gtest/gtest.h>

#include <climits>
#include <set>
#include <string>

#include "ents.h"

namespace status_test {
namespace {

struct Pinned {
  int32_t value, pinned;
};
// Written out on purpose: a change of the header's table must not change this one.
const Pinned pinned[] = {
    {ENTS_OK, 0},
    {ENTS_NO_PROJECTION, 1},
    {ENTS_SINGULAR_PROJECTION, 2},
    {ENTS_AMBIGUOUS_PROJECTION, 3},
    {ENTS_DEGENERATE_SEGMENT, 4},
    {ENTS_GRAZING_RAY, 5},
    {ENTS_DEEP_PENETRATION, 6},
    {ENTS_OUT_OF_RANGE, 7},
    {ENTS_NULL_ARGUMENT, -1},
    {ENTS_STRUCT_SIZE, -2},
    {ENTS_VERSION, -3},
    {ENTS_NON_FINITE, -4},
    {ENTS_JSON_SYNTAX, -5},
    {ENTS_UNKNOWN_KEY, -6},
    {ENTS_BAD_VALUE, -7},
    {ENTS_FILE, -8},
    {ENTS_BAD_MASK, -9},
    {ENTS_BAD_COUNT, -10},
    {ENTS_BAD_HANDLE, -11},
    {ENTS_BAD_STATE, -12},
    {ENTS_BAD_PATTERN, -13},
    {ENTS_NO_MEMORY, -100},
    {ENTS_INTERNAL, -101},
};

TEST(Status, ValuesArePinned) {
  for (const Pinned& p : pinned) EXPECT_EQ(p.value, p.pinned);
}

TEST(Status, BitsArePinned) {
  const int32_t wanted[] = {ENTS_XI,         ENTS_GAP,          ENTS_NORMAL_GAP,  ENTS_NORMAL,
                            ENTS_POINT,      ENTS_GAP_GRADIENT, ENTS_GAP_HESSIAN, ENTS_XI_GRADIENT,
                            ENTS_XI_HESSIAN, ENTS_ENERGY,       ENTS_PRESSURE,    ENTS_RESIDUAL,
                            ENTS_TANGENT,    ENTS_STATE,        ENTS_FLAGS,       ENTS_ITERATIONS,
                            ENTS_TRACTION,   ENTS_SLIP,         ENTS_AGE};
  for (std::size_t bit = 0; bit < std::size(wanted); ++bit) EXPECT_EQ(wanted[bit], 1 << bit);
  EXPECT_EQ(ENTS_FLAG_CONTACT, 1);
  EXPECT_EQ(ENTS_FLAG_OUTSIDE, 2);
  EXPECT_EQ(ENTS_FLAG_FAR_SIDE, 4);
  EXPECT_EQ(ENTS_FLAG_SEARCHED, 8);
  EXPECT_EQ(ENTS_FLAG_STICK, 16);
  EXPECT_EQ(ENTS_FLAG_SLIP, 32);
  EXPECT_EQ(ENTS_FLAG_SHEAR_LIMIT, 64);
  EXPECT_EQ(ENTS_FLAG_CHANGED, 128);
}

TEST(Status, EveryValueHasATextOfItsOwn) {
  std::set<std::string> texts;
  for (const Pinned& p : pinned) {
    ASSERT_NE(ents_status_text(p.value), nullptr);
    EXPECT_GE(std::string(ents_status_text(p.value)).size(), 2u);
    EXPECT_TRUE(texts.insert(ents_status_text(p.value)).second) << p.value;
  }
  const std::string unknown = ents_status_text(12345);
  EXPECT_FALSE(texts.contains(unknown));
  for (const int32_t value : {99, 8, -14, -102, INT_MAX, INT_MIN})
    EXPECT_EQ(ents_status_text(value), unknown) << value;
}

TEST(Status, ContractVersionsAreChecked) {
  ents_report report{};
  report.struct_size = sizeof report;
  EXPECT_EQ(ents_check_contract(ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR, &report), ENTS_OK);
  EXPECT_EQ(ents_check_contract(ENTS_CONTRACT_MAJOR, 0, nullptr), ENTS_OK);
  const int32_t refused[][2] = {{ENTS_CONTRACT_MAJOR, ENTS_CONTRACT_MINOR + 1},
                                {ENTS_CONTRACT_MAJOR + 1, 0},
                                {0, 0},
                                {ENTS_CONTRACT_MAJOR, -1},
                                {INT_MAX, INT_MAX},
                                {INT_MIN, 0}};
  for (const auto& version : refused) {
    EXPECT_EQ(ents_check_contract(version[0], version[1], &report), ENTS_VERSION);
    EXPECT_NE(std::string(report.message).find(std::to_string(version[0]) + "." + std::to_string(version[1])),
              std::string::npos)
        << report.message;
  }
  EXPECT_STRNE(ents_version(), "");
}

} // namespace
} // namespace status_test
