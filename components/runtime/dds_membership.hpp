#pragma once
#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "runtime/dds_transport.hpp"
#include "runtime/server_watch.hpp"

namespace eprosima::fastdds::dds {
class DomainParticipant;
class Publisher;
class Subscriber;
class Topic;
}  // namespace eprosima::fastdds::dds

namespace coop::runtime {

/// A participant and what belongs to it, from joining the domain to leaving it.
struct Membership {
  ServerWatch::Wall::time_point begin = ServerWatch::Wall::now();
  ServerWatch watch;
  eprosima::fastdds::dds::DomainParticipant* participant;
  eprosima::fastdds::dds::Publisher* publisher = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber = nullptr;

  /// `on_server`: the discovery server was found; called on a thread of Fast DDS. Throws
  /// std::runtime_error.
  Membership(const DdsOptions& options, std::function<void()> on_server);
  ~Membership();
  Membership(const Membership&) = delete;
  Membership& operator=(const Membership&) = delete;
  /// Throws std::runtime_error where the topic has another type.
  eprosima::fastdds::dds::Topic* topic(const std::string& name, const MessageType& type);

 private:
  std::mutex mutex_;
  std::map<std::string, eprosima::fastdds::dds::Topic*> topics_;
};

}  // namespace coop::runtime
