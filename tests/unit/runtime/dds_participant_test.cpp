#include "runtime/dds_participant.hpp"

#include <fastdds/rtps/transport/ChainingTransportDescriptor.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <iterator>

#include "core/config/error.hpp"

namespace coop::runtime {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The interfaces a participant keeps to, behind the guard of its packets; none: all of them.
std::vector<std::string> interfaces(const eprosima::fastdds::dds::DomainParticipantQos& qos) {
  namespace rtps = eprosima::fastdds::rtps;
  const auto guard = std::dynamic_pointer_cast<rtps::ChainingTransportDescriptor>(
      qos.transport().user_transports.at(0));
  const auto udp =
      std::dynamic_pointer_cast<rtps::UDPv4TransportDescriptor>(guard->low_level_descriptor);
  return udp->interfaceWhiteList;
}

std::vector<std::string> interfaces() {
  return interfaces(participant_qos(
      {}, {.domain = 0, .participant_name = "x", .partition = {}, .reliable_streams = false}));
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

eprosima::fastdds::dds::DomainParticipantQos qos_of(const std::vector<std::string>& settings) {
  DdsOptions options;
  options.participant_name = "amcl";
  options.settings = read_dds_settings(settings);
  return participant_qos({}, options);
}

std::string error_of(const std::vector<std::string>& settings) {
  try {
    (void)qos_of(settings);
  } catch (const config::Error& problem) {
    return problem.what();
  }
  return "no error";
}

std::string property(const eprosima::fastdds::dds::DomainParticipantQos& qos,
                     const std::string& name) {
  for (const auto& entry : qos.properties().properties()) {
    if (entry.name() == name) return entry.value();
  }
  return "";
}

TEST(ParticipantQos, keeps_to_the_interfaces_named_or_says_which_there_are) {
  EXPECT_THAT(interfaces(qos_of({"interfaces=[lo]"})), ElementsAre("127.0.0.1"));
  EXPECT_THAT(error_of({"interfaces=[barn0]"}),
              HasSubstr("dds.interfaces: no interface 'barn0' here; there are: "));
}

TEST(ParticipantQos, looks_for_peers_on_the_hosts_named_and_on_its_own) {
  const auto qos = qos_of({"discovery=peers", "peers=[10.1.2.3]", "peer_participants=9"});
  const auto& peers = qos.wire_protocol().builtin.initialPeersList;
  ASSERT_EQ(peers.size(), 2U);
  EXPECT_TRUE(peers.begin()->address[12] == 127);
  EXPECT_EQ(std::next(peers.begin())->address[15], 3);
  EXPECT_EQ(qos.transport().user_transports.at(0)->maxInitialPeersRange, 9U);
  EXPECT_THAT(error_of({"discovery=peers", "peers=[no-such-host.invalid]"}),
              HasSubstr("dds.peers: no address of 'no-such-host.invalid'"));
}

TEST(ParticipantQos, asks_the_discovery_server_named) {
  const auto qos = qos_of({"discovery=server", "server=10.1.2.3:11811"});
  const auto& discovery = qos.wire_protocol().builtin.discovery_config;
  EXPECT_EQ(discovery.discoveryProtocol, eprosima::fastrtps::rtps::DiscoveryProtocol_t::CLIENT);
  ASSERT_EQ(discovery.m_DiscoveryServers.size(), 1U);
  EXPECT_EQ(discovery.m_DiscoveryServers.front().metatrafficUnicastLocatorList.begin()->port,
            11811U);
}

TEST(ParticipantQos, remembers_who_is_silent_for_longer_where_a_server_knows_everybody) {
  const auto lease = [](const std::vector<std::string>& dds) {
    return qos_of(dds).wire_protocol().builtin.discovery_config.leaseDuration.seconds;
  };
  EXPECT_EQ(lease({}), 5);
  EXPECT_EQ(lease({"discovery=server", "server=10.1.2.3:11811"}), 18);
  EXPECT_EQ(lease({"lease=7"}), 7);
}

TEST(ParticipantQos, takes_itself_for_forgotten_before_others_forget_it) {
  using std::chrono::milliseconds;
  const auto after = [](const std::vector<std::string>& dds) {
    return forgotten_after(read_dds_settings(dds));
  };
  EXPECT_EQ(after({}), milliseconds(4000));
  EXPECT_EQ(after({"discovery=server", "server=10.1.2.3:11811"}), milliseconds(17000));
  EXPECT_EQ(after({"lease=1"}), milliseconds(500));
  // A sign of life is never older than a second.
  EXPECT_LT(qos_of({}).wire_protocol().builtin.discovery_config.leaseDuration_announcementperiod,
            eprosima::fastrtps::Duration_t(1, 0));
}

TEST(ParticipantQos, is_introduced_by_udp_alone_where_there_are_keys_and_shared_memory) {
  const auto kept = qos_of({"security=on", "keys=/keys", "transport=shm"});
  EXPECT_EQ(kept.wire_protocol().builtin.metatrafficUnicastLocatorList.size(), 1U);
  EXPECT_EQ(kept.wire_protocol().builtin.metatrafficMulticastLocatorList.size(), 1U);
  EXPECT_TRUE(kept.wire_protocol().default_unicast_locator_list.empty());
  EXPECT_TRUE(
      qos_of({"transport=shm"}).wire_protocol().builtin.metatrafficUnicastLocatorList.empty());
}

TEST(ParticipantQos, takes_its_own_keys_out_of_the_folder) {
  const auto qos = qos_of({"security=on", "keys=/keys"});
  EXPECT_EQ(property(qos, "dds.sec.auth.builtin.PKI-DH.private_key"), "file:///keys/amcl/key.pem");
  EXPECT_EQ(property(qos, "dds.sec.access.builtin.Access-Permissions.governance"),
            "file:///keys/public/governance.p7s");
  EXPECT_TRUE(property(qos_of({}), "dds.sec.auth.plugin").empty());
}

}  // namespace
}  // namespace coop::runtime
