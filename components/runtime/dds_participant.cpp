#include "runtime/dds_participant.hpp"

#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <algorithm>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <stdexcept>
#include <string_view>

#include "core/config/error.hpp"
#include "runtime/network.hpp"
#include "runtime/packet_guard.hpp"
#include "runtime/security_keys.hpp"

namespace coop::runtime {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastrtps::Duration_t;

namespace {

constexpr std::uint32_t kSocketBuffer = 4U << 20U;
constexpr std::uint32_t kSharedSegment = 8U << 20U;
/// Longer than the launcher's patience of 3 s with a silent program: one that is stopped and goes
/// on must not have been forgotten by those it remembers, or their halves of the connections never
/// fit again.
constexpr std::chrono::seconds kLease{5};
/// With a server it must outlast a cut: who has been given up by some and not by all stays lost
/// (docs/hosts.md).
constexpr std::chrono::seconds kServedLease{18};
constexpr const char* kLoopback = "127.0.0.1";
constexpr std::uint32_t kSoonAnnouncements = 12;
const Duration_t kSoonPeriod{0, 40'000'000};

/// As for ROS 2's programs.
bool stays_on_this_machine() {
  const char* wanted = std::getenv("ROS_LOCALHOST_ONLY");
  return wanted != nullptr && std::string_view(wanted) == "1";
}

std::vector<std::string> own_addresses(const DdsSettings& settings) {
  if (stays_on_this_machine()) return {kLoopback};
  std::vector<std::string> addresses;
  for (const std::string& interface : settings.interfaces) {
    addresses.push_back(interface_address(interface));
  }
  return addresses;
}

void add_transports(const DdsSettings& settings,
                    const std::shared_ptr<Introductions>& introductions,
                    dds::DomainParticipantQos& qos) {
  qos.transport().use_builtin_transports = false;
  if (settings.transport == "shm") {
    auto shared = std::make_shared<eprosima::fastdds::rtps::SharedMemTransportDescriptor>();
    shared->segment_size(kSharedSegment);
    qos.transport().user_transports.push_back(shared);
  }
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->sendBufferSize = kSocketBuffer;
  udp->receiveBufferSize = kSocketBuffer;
  udp->interfaceWhiteList = own_addresses(settings);
  if (settings.discovery == "peers") {
    udp->maxInitialPeersRange = static_cast<std::uint32_t>(settings.peer_participants);
  }
  qos.transport().user_transports.push_back(guarded(udp, introductions));
}

/// Port 0: Fast DDS tries the usual ports of the domain, as many as the transport's range.
rtps::Locator_t udp_locator(const std::string& address, std::uint32_t port) {
  rtps::Locator_t locator;
  rtps::IPLocator::createLocator(LOCATOR_KIND_UDPv4, address, port, locator);
  return locator;
}

void add_peers(const DdsSettings& settings, dds::DomainParticipantQos& qos) {
  auto& peers = qos.wire_protocol().builtin.initialPeersList;
  // Those on this host, too: nobody else's announcements reach them where multicast is blocked.
  const auto own = own_addresses(settings);
  peers.push_back(udp_locator(own.empty() ? kLoopback : own.front(), 0));
  for (const std::string& peer : settings.peers) {
    peers.push_back(udp_locator(host_address(peer, "dds.peers"), 0));
  }
}

void join_server(const DdsOptions& options, dds::DomainParticipantQos& qos) {
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.discoveryProtocol = options.sees_all_topics ? rtps::DiscoveryProtocol_t::SUPER_CLIENT
                                                        : rtps::DiscoveryProtocol_t::CLIENT;
  const std::string& server = options.settings.server;
  const std::size_t colon = server.rfind(':');
  rtps::RemoteServerAttributes attributes;
  rtps::get_server_client_default_guidPrefix(0, attributes.guidPrefix);
  attributes.metatrafficUnicastLocatorList.push_back(
      udp_locator(host_address(server.substr(0, colon), "dds.server"),
                  static_cast<std::uint32_t>(std::stoi(server.substr(colon + 1)))));
  discovery.m_DiscoveryServers.push_back(attributes);
}

/// Everybody's introductions come through the guard, which Fast DDS does not let stand before
/// shared memory; data go there all the same.
void be_introduced_by_udp(dds::DomainParticipantQos& qos) {
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(udp_locator("0.0.0.0", 0));
  builtin.metatrafficMulticastLocatorList.push_back(udp_locator("239.255.0.1", 0));
}

void add_security(const DdsOptions& options, dds::DomainParticipantQos& qos) {
  // The first announcement is not sent (Introductions): the next comes soon.
  auto& announcements = qos.wire_protocol().builtin.discovery_config.initial_announcements;
  announcements = {kSoonAnnouncements, kSoonPeriod};
  if (options.settings.transport == "shm") be_introduced_by_udp(qos);
  const KeyFiles files(options.settings.keys, options.participant_name);
  const auto add = [&qos](const std::string& name, const std::string& value) {
    qos.properties().properties().emplace_back(name, value);
  };
  const auto add_file = [&add](const std::string& name, const std::filesystem::path& file) {
    add(name, "file://" + std::filesystem::absolute(file).lexically_normal().string());
  };
  const std::string identity = "dds.sec.auth.builtin.PKI-DH.";
  add("dds.sec.auth.plugin", "builtin.PKI-DH");
  add_file(identity + "identity_ca", files.identity_ca);
  add_file(identity + "identity_certificate", files.certificate);
  add_file(identity + "private_key", files.key);
  std::error_code error;
  if (std::filesystem::exists(files.revoked, error)) {
    add_file(identity + "identity_crl", files.revoked);
  }
  const std::string access = "dds.sec.access.builtin.Access-Permissions.";
  add("dds.sec.access.plugin", "builtin.Access-Permissions");
  add_file(access + "permissions_ca", files.permissions_ca);
  add_file(access + "governance", files.governance);
  add_file(access + "permissions", files.permissions);
  add("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

}  // namespace

std::chrono::seconds lease(const DdsSettings& settings) {
  if (settings.lease > 0) return std::chrono::seconds(settings.lease);
  return settings.discovery == "server" ? kServedLease : kLease;
}

std::chrono::milliseconds forgotten_after(const DdsSettings& settings) {
  const std::chrono::milliseconds all = lease(settings);
  return std::max(all - kSignOfLife, all / 2);
}

std::chrono::milliseconds run_out_after(const DdsSettings& settings) {
  // A look every half a second tells when the pause began.
  return lease(settings) + std::chrono::milliseconds(800);
}

dds::DomainParticipantQos participant_qos(dds::DomainParticipantQos base, const DdsOptions& options,
                                          const std::shared_ptr<Introductions>& introductions) {
  const DdsSettings& settings = options.settings;
  base.name(options.participant_name);
  add_transports(settings, introductions, base);
  auto& discovery = base.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = Duration_t(static_cast<std::int32_t>(lease(settings).count()), 0);
  discovery.leaseDuration_announcementperiod = Duration_t(0, 660'000'000);
  if (settings.discovery == "peers") add_peers(settings, base);
  if (settings.discovery == "server") join_server(options, base);
  if (settings.security) add_security(options, base);
  return base;
}

dds::DomainParticipant* create_participant(const DdsOptions& options,
                                           dds::DomainParticipantListener* listener) {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  const auto introductions =
      options.settings.security ? std::make_shared<Introductions>() : nullptr;
  auto qos = participant_qos(factory->get_default_participant_qos(), options, introductions);
  // No status of endpoints for the listener: they have listeners of their own.
  dds::DomainParticipant* participant = factory->create_participant(
      static_cast<dds::DomainId_t>(options.domain), qos, listener, dds::StatusMask::none());
  if (participant == nullptr) {
    throw std::runtime_error("DDS: cannot join domain " + std::to_string(options.domain));
  }
  if (introductions) introductions->may_announce = true;
  return participant;
}

}  // namespace coop::runtime
