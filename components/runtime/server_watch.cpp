#include "runtime/server_watch.hpp"

#include <fastdds/rtps/attributes/ServerAttributes.h>
#include <fastdds/rtps/participant/ParticipantDiscoveryInfo.h>

namespace coop::runtime {
namespace {

namespace rtps = eprosima::fastrtps::rtps;
using rtps::ParticipantDiscoveryInfo;

bool is_server(const rtps::GuidPrefix_t& prefix) {
  rtps::GuidPrefix_t server;
  rtps::get_server_client_default_guidPrefix(0, server);
  return prefix == server;
}

}  // namespace

bool ServerWatch::sees_server() const {
  const std::scoped_lock lock(mutex_);
  return sees_;
}

bool ServerWatch::has_lost_server(Wall::duration ago) const {
  const std::scoped_lock lock(mutex_);
  return lost_ && Wall::now() - *lost_ >= ago;
}

void ServerWatch::on_participant_discovery(eprosima::fastdds::dds::DomainParticipant*,
                                           ParticipantDiscoveryInfo&& info) {
  if (!is_server(info.info.m_guid.guidPrefix)) return;
  const bool is_gone = info.status == ParticipantDiscoveryInfo::DROPPED_PARTICIPANT ||
                       info.status == ParticipantDiscoveryInfo::REMOVED_PARTICIPANT;
  {
    const std::scoped_lock lock(mutex_);
    sees_ = !is_gone;
    lost_ = is_gone ? std::optional(Wall::now()) : std::nullopt;
  }
  if (!is_gone) on_found_();
}

}  // namespace coop::runtime
