#pragma once
#include <map>
#include <mutex>
#include <string>

#include "runtime/dds_transport.hpp"

namespace eprosima::fastdds::dds {
class DomainParticipant;
class DomainParticipantListener;
class Publisher;
class Subscriber;
class Topic;
}  // namespace eprosima::fastdds::dds

namespace coop::runtime {

/// What is made in a participant, and made anew in its successor.
class DdsEndpoint {
 public:
  virtual ~DdsEndpoint() = default;
  virtual void enter() = 0;
  virtual void leave() = 0;
  /// From any thread: the one that uses it should look.
  virtual void nudge() {}
};

/// A participant and what belongs to it, from joining the domain to leaving it.
struct Membership {
  eprosima::fastdds::dds::DomainParticipant* participant;
  eprosima::fastdds::dds::Publisher* publisher = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber = nullptr;

  /// `listener` must outlive it. Throws std::runtime_error.
  Membership(const DdsOptions& options,
             eprosima::fastdds::dds::DomainParticipantListener& listener);
  ~Membership();
  Membership(const Membership&) = delete;
  Membership& operator=(const Membership&) = delete;
  /// `name`: as on the wire. Throws std::runtime_error where the topic has another type.
  eprosima::fastdds::dds::Topic* topic(const std::string& name, const MessageType& type);

 private:
  std::mutex mutex_;
  std::map<std::string, eprosima::fastdds::dds::Topic*> topics_;
};

}  // namespace coop::runtime
