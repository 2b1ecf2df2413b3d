#include "runtime/dds_membership.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/PublisherQos.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/SubscriberQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <stdexcept>

#include "runtime/dds_participant.hpp"

namespace coop::runtime {

namespace dds = eprosima::fastdds::dds;

Membership::Membership(const DdsOptions& options, dds::DomainParticipantListener& listener)
    : participant(create_participant(options, &listener)) {
  dds::PublisherQos publisher_qos = participant->get_default_publisher_qos();
  dds::SubscriberQos subscriber_qos = participant->get_default_subscriber_qos();
  if (!options.partition.empty()) {
    publisher_qos.partition().push_back(options.partition.c_str());
    subscriber_qos.partition().push_back(options.partition.c_str());
  }
  publisher = participant->create_publisher(publisher_qos);
  subscriber = participant->create_subscriber(subscriber_qos);
  if (publisher == nullptr || subscriber == nullptr)
    throw std::runtime_error("DDS: cannot create endpoints");
}

Membership::~Membership() {
  participant->set_listener(nullptr);
  participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
}

dds::Topic* Membership::topic(const std::string& name, const MessageType& type) {
  const std::scoped_lock lock(mutex_);
  auto& entry = topics_[name];
  if (entry == nullptr) {
    if (participant->find_type(type.name()) == nullptr) {
      dds::TypeSupport support(type.new_dds_type());
      support.register_type(participant, type.name());
    }
    entry = participant->create_topic(name, type.name(), dds::TOPIC_QOS_DEFAULT);
  }
  if (entry == nullptr) throw std::runtime_error("DDS: cannot create topic " + name);
  if (entry->get_type_name() != type.name()) {
    throw std::runtime_error("DDS: topic " + name + " carries " + entry->get_type_name() +
                             ", not " + type.name());
  }
  return entry;
}

}  // namespace coop::runtime
