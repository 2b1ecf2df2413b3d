#include "arm_driver/pick_record.hpp"

#include <gtest/gtest.h>

namespace coop::arm_driver {
namespace {

TEST(PickRecord, ComesBackFromItsTextAsItWas) {
  PickRecord record;
  record.running = RunningPick{"p3", "egg_3", PickStage::kHolding};
  record.add({"p1", "egg_1", PickOutcome::kPicked, ""});
  record.add({"p2", "egg_2", PickOutcome::kNoVacuum, "said \"nothing\"\n"});
  const auto back = parse_pick_record(to_text(record));
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(*back, record);
}

TEST(PickRecord, WithoutARunningPickComesBackToo) {
  const auto back = parse_pick_record(to_text(PickRecord{}));
  ASSERT_TRUE(back) << back.error();
  EXPECT_EQ(*back, PickRecord{});
}

TEST(PickRecord, EveryCutOffTextIsRefusedWithAReason) {
  PickRecord record;
  record.add({"p1", "egg_1", PickOutcome::kPicked, ""});
  const std::string text = to_text(record);
  for (std::size_t length = 0; length + 2 < text.size(); ++length) {
    const auto back = parse_pick_record(text.substr(0, length));
    ASSERT_FALSE(back) << length;
    EXPECT_FALSE(back.error().empty());
  }
}

TEST(PickRecord, UnknownStageOrFormatIsRefused) {
  EXPECT_FALSE(parse_pick_record(R"({"format": "another", "running": null, "results": []})"));
  EXPECT_FALSE(parse_pick_record(
      R"({"format": "coop pick record 1", "results": [],
          "running": {"pick_id": "p", "egg_id": "e", "stage": "dreaming"}})"));
}

TEST(PickRecord, RemembersTheLastResultsOnly) {
  PickRecord record;
  for (std::size_t i = 0; i < PickRecord::kMaxResults + 3; ++i) {
    record.add({std::to_string(i), "", PickOutcome::kPicked, ""});
  }
  EXPECT_EQ(record.results.size(), PickRecord::kMaxResults);
  EXPECT_EQ(record.find("2"), nullptr);
  EXPECT_NE(record.find("3"), nullptr);
}

TEST(PickRecord, NamesThatAreNoTextDoNotStopTheDriver) {
  PickRecord record;
  record.add({"p\xff", "egg", PickOutcome::kPicked, ""});
  EXPECT_TRUE(parse_pick_record(to_text(record)));
}

}  // namespace
}  // namespace coop::arm_driver
