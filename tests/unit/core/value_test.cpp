// SPDX-License-Identifier: MIT
#include "core/value.h"

#include <gtest/gtest.h>

namespace millstudy::core {
namespace {

TEST(Value, FindsMembersOfTablesOnly) {
  const Value table{Value::Table{{"depth", {0.5, {}}}, {"flutes", {std::int64_t{2}, {}}}}, {}};
  ASSERT_NE(table.find("flutes"), nullptr);
  EXPECT_EQ(table.find("flutes")->number(), 2.0);
  EXPECT_EQ(table.find("helix"), nullptr);
  EXPECT_EQ(table.find("depth")->find("x"), nullptr);
}

TEST(InputError, HasOneLineForEachFault) {
  const InputError error(
      {{{"a.toml", 3}, "first"}, {{"a.toml", 0}, "second\nline"}, {{}, "third"}});
  EXPECT_STREQ(error.what(), "a.toml:3: first\na.toml: second?line\nthird");
}

}  // namespace
}  // namespace millstudy::core
