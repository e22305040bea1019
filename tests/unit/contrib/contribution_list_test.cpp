#include "contrib/contribution_list.h"

#include <gtest/gtest.h>

#include <array>

namespace rsphere {
namespace {

TEST(ContributionList, AddsUpByColumn) {
  ContributionList list(3);
  list.add(7, std::array{1., 2., 3.});
  list.add(1u << 31, std::array{1., 1., 1.});
  list.add(7, std::array{.5, .5, .5});
  ASSERT_EQ(list.columns().size(), 2u);
  EXPECT_EQ(list.columns()[0], 7u);
  EXPECT_EQ(list.columns()[1], 1u << 31);
  EXPECT_EQ(std::vector<double>(list.values().begin(), list.values().end()),
            (std::vector<double>{1.5, 2.5, 3.5, 1, 1, 1}));
}

TEST(ContributionList, KeepsTheOrderOfManyColumnsAndIsClearedWhole) {
  ContributionList list(1);
  for (int round = 0; round < 3; ++round) {
    const uint32_t count = round == 1 ? 3 : 5000;
    for (uint32_t pass = 0; pass < 2; ++pass)
      for (uint32_t i = 0; i < count; ++i) list.add(i * 4097, std::array{1. + i});
    ASSERT_EQ(list.columns().size(), count);
    for (uint32_t i = 0; i < count; ++i) {
      EXPECT_EQ(list.columns()[i], i * 4097);
      EXPECT_EQ(list.values()[i], 2 * (1. + i));
    }
    list.clear();
    EXPECT_TRUE(list.columns().empty());
  }
}

}  // namespace
}  // namespace rsphere
