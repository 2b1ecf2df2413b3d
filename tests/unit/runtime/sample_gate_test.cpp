#include "runtime/lockstep/sample_gate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coop_msgs/msg/EmergencyStop.h"
#include "std_msgs/msg/String.h"

namespace coop::runtime {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class SampleGateTest : public ::testing::Test {
 protected:
  static Sample sample(const std::string& writer, std::uint64_t sequence) {
    auto message = std::make_shared<std_msgs::msg::String>();
    message->data(writer + std::to_string(sequence));
    return {message, writer, sequence};
  }
  static Sample keyed(const std::string& source, std::uint64_t sequence) {
    auto message = std::make_shared<coop_msgs::msg::EmergencyStop>();
    message->source(source);
    return {message, "w", sequence};
  }
  static std::vector<std::string> released(SampleGate& gate) {
    std::vector<std::string> texts;
    Sample next;
    while (gate.next(next)) texts.push_back(next.writer + std::to_string(next.sequence));
    return texts;
  }
  SampleGate stream_{message_type<std_msgs::msg::String>(), false};
  SampleGate latched_{message_type<std_msgs::msg::String>(), true};
  const WriterRank first_{"amcl", 3};
  const WriterRank second_{"dwa", 0};
};

TEST_F(SampleGateTest, LetsNothingOutBeforeItsTick) {
  stream_.admit("a", first_, 0);
  stream_.hold(sample("a", 1));
  stream_.release();
  EXPECT_THAT(released(stream_), IsEmpty());
  stream_.expect(first_, 1);
  stream_.release();
  EXPECT_THAT(released(stream_), ElementsAre("a1"));
}

TEST_F(SampleGateTest, OrdersByComponentAndSequenceWhateverTheArrival) {
  stream_.admit("z", first_, 0);
  stream_.admit("a", second_, 0);
  for (const std::uint64_t sequence : {1U, 2U}) {
    stream_.hold(sample("a", sequence));
    stream_.hold(sample("z", sequence));
  }
  stream_.expect(second_, 2);
  stream_.expect(first_, 2);
  stream_.release();
  EXPECT_THAT(released(stream_), ElementsAre("z1", "z2", "a1", "a2"));
}

TEST_F(SampleGateTest, KeepsWhatBelongsToALaterTick) {
  stream_.admit("a", first_, 0);
  stream_.expect(first_, 1);
  stream_.hold(sample("a", 1));
  stream_.hold(sample("a", 2));
  stream_.release();
  EXPECT_THAT(released(stream_), ElementsAre("a1"));
  stream_.expect(first_, 2);
  stream_.release();
  EXPECT_THAT(released(stream_), ElementsAre("a2"));
}

TEST_F(SampleGateTest, IsCompleteOnlyWithTheLastSampleExpected) {
  stream_.admit("a", first_, 0);
  EXPECT_TRUE(stream_.is_complete());
  stream_.expect(first_, 2);
  stream_.hold(sample("a", 1));
  EXPECT_FALSE(stream_.is_complete());
  EXPECT_EQ(stream_.missing(), "sample 2 of amcl, has 1");
  stream_.hold(sample("a", 2));
  EXPECT_TRUE(stream_.is_complete());
}

TEST_F(SampleGateTest, DropsOfAStreamWhatWasWrittenBeforeBothKnewEachOther) {
  stream_.hold(sample("a", 1));  // matched early, by luck
  stream_.admit("a", first_, 2);
  EXPECT_TRUE(stream_.is_complete());
  stream_.hold(sample("a", 2));
  stream_.hold(sample("a", 3));
  stream_.expect(first_, 3);
  stream_.release();
  EXPECT_THAT(released(stream_), ElementsAre("a3"));
}

TEST_F(SampleGateTest, WaitsForTheLatchedSampleOfAWriterThatWasThereBefore) {
  latched_.admit("a", first_, 4);
  EXPECT_FALSE(latched_.is_complete());
  latched_.hold(sample("a", 4));
  EXPECT_TRUE(latched_.is_complete());
  latched_.release();
  EXPECT_THAT(released(latched_), ElementsAre("a4"));
}

TEST_F(SampleGateTest, OfALatchedTopicOnlyTheNewestOfEachInstanceComesOut) {
  SampleGate stops(message_type<coop_msgs::msg::EmergencyStop>(), true);
  stops.admit("w", first_, 0);
  stops.hold(keyed("button", 1));
  stops.hold(keyed("fence", 2));
  stops.hold(keyed("button", 3));
  stops.expect(first_, 3);
  stops.release();
  EXPECT_THAT(released(stops), ElementsAre("w2", "w3"));
}

TEST_F(SampleGateTest, StrangersComeLastAndAreCounted) {
  stream_.admit("a", first_, 0);
  stream_.hold(sample("person", 1));
  stream_.hold(sample("a", 1));
  stream_.expect(first_, 1);
  stream_.release();
  EXPECT_THAT(released(stream_), ElementsAre("a1", "person1"));
  EXPECT_EQ(stream_.from_outside(), 1U);
}

TEST_F(SampleGateTest, ForgetsAWriterThatIsGoneWithWhatItLeftBehind) {
  stream_.admit("a", first_, 0);
  stream_.expect(first_, 1);
  stream_.hold(sample("a", 1));
  stream_.keep_only({"b"});
  stream_.admit("b", first_, 0);
  stream_.release();
  EXPECT_THAT(released(stream_), IsEmpty());
  EXPECT_TRUE(stream_.is_complete());
}

TEST_F(SampleGateTest, GoesOnWithoutLostSamplesWhenToldTo) {
  stream_.admit("a", first_, 0);
  stream_.expect(first_, 5);
  stream_.hold(sample("a", 1));
  stream_.forgo_missing();
  EXPECT_TRUE(stream_.is_complete());
  stream_.hold(sample("a", 6));
  stream_.expect(first_, 6);
  stream_.release();
  EXPECT_THAT(released(stream_), ElementsAre("a1", "a6"));
}

}  // namespace
}  // namespace coop::runtime
