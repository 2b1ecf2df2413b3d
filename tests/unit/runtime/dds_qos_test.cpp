#include "runtime/dds_qos.hpp"

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace coop::runtime {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// The interfaces a participant keeps to; none: all of them.
std::vector<std::string> interfaces() {
  const auto qos = participant_qos(
      {}, {.domain = 0, .participant_name = "x", .partition = {}, .reliable_streams = false});
  const auto udp = std::dynamic_pointer_cast<eprosima::fastdds::rtps::UDPv4TransportDescriptor>(
      qos.transport().user_transports.at(0));
  return udp->interfaceWhiteList;
}

TEST(ParticipantQos, keeps_to_this_machine_only_where_the_environment_says_so) {
  ::unsetenv("ROS_LOCALHOST_ONLY");
  EXPECT_THAT(interfaces(), IsEmpty());
  ::setenv("ROS_LOCALHOST_ONLY", "0", 1);
  EXPECT_THAT(interfaces(), IsEmpty());
  ::setenv("ROS_LOCALHOST_ONLY", "1", 1);
  EXPECT_THAT(interfaces(), ElementsAre("127.0.0.1"));
  ::unsetenv("ROS_LOCALHOST_ONLY");
}

}  // namespace
}  // namespace coop::runtime
