#pragma once
#include <atomic>
#include <fastdds/dds/core/condition/GuardCondition.hpp>
#include <fastdds/dds/core/condition/WaitSet.hpp>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <functional>
#include <stdexcept>
#include <string>
#include <thread>

#include "runtime/dds_participant.hpp"
#include "runtime/dds_qos.hpp"
#include "runtime/message_type.hpp"

namespace coop::bench {

/// Fast DDS as one uses it without Coop's runtime, with the same transport and QoS: what the
/// runtime is measured against.
class RawParticipant {
 public:
  RawParticipant(const runtime::DdsOptions& options, const runtime::MessageType& type)
      : options_(options) {
    namespace dds = eprosima::fastdds::dds;
    auto* factory = dds::DomainParticipantFactory::get_instance();
    participant_ = factory->create_participant(
        static_cast<dds::DomainId_t>(options.domain),
        runtime::participant_qos(factory->get_default_participant_qos(), options));
    if (participant_ == nullptr) throw std::runtime_error("no participant");
    dds::TypeSupport(type.new_dds_type()).register_type(participant_, type.name());
  }
  ~RawParticipant() {
    participant_->delete_contained_entities();
    eprosima::fastdds::dds::DomainParticipantFactory::get_instance()->delete_participant(
        participant_);
  }
  RawParticipant(const RawParticipant&) = delete;
  RawParticipant& operator=(const RawParticipant&) = delete;

  [[nodiscard]] eprosima::fastdds::dds::DataWriter* writer(const std::string& topic,
                                                           const runtime::MessageType& type,
                                                           runtime::Qos intent) {
    auto* publisher = participant_->create_publisher(participant_->get_default_publisher_qos());
    auto qos = publisher->get_default_datawriter_qos();
    runtime::apply_intent(intent, options_, qos);
    return publisher->create_datawriter(
        participant_->create_topic(topic, type.name(), eprosima::fastdds::dds::TOPIC_QOS_DEFAULT),
        qos);
  }
  [[nodiscard]] eprosima::fastdds::dds::DataReader* reader(
      const std::string& topic, const runtime::MessageType& type, runtime::Qos intent,
      eprosima::fastdds::dds::DataReaderListener* listener) {
    namespace dds = eprosima::fastdds::dds;
    auto* subscriber = participant_->create_subscriber(participant_->get_default_subscriber_qos());
    auto qos = subscriber->get_default_datareader_qos();
    runtime::apply_intent(intent, options_, qos);
    return subscriber->create_datareader(
        participant_->create_topic(topic, type.name(), dds::TOPIC_QOS_DEFAULT), qos, listener,
        listener == nullptr ? dds::StatusMask::none() : dds::StatusMask::data_available());
  }

 private:
  runtime::DdsOptions options_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
};

/// Takes in the middleware's own thread, as soon as there is something.
template <class Message>
class RawListener : public eprosima::fastdds::dds::DataReaderListener {
 public:
  explicit RawListener(std::function<void(const Message&)> callback)
      : callback_(std::move(callback)) {}
  void on_data_available(eprosima::fastdds::dds::DataReader* reader) override {
    eprosima::fastdds::dds::SampleInfo info;
    while (reader->take_next_sample(&message_, &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (info.valid_data) callback_(message_);
    }
  }

 private:
  std::function<void(const Message&)> callback_;
  Message message_;
};

/// Takes in a thread of its own, which waits for data: callbacks of several readers would not
/// overlap, as in a component of Coop.
template <class Message>
class RawWaiter {
 public:
  RawWaiter(eprosima::fastdds::dds::DataReader* reader,
            std::function<void(const Message&)> callback)
      : reader_(reader), callback_(std::move(callback)) {
    auto& condition = reader_->get_statuscondition();
    condition.set_enabled_statuses(eprosima::fastdds::dds::StatusMask::data_available());
    waits_.attach_condition(condition);
    waits_.attach_condition(end_);
    thread_ = std::thread([this] { run(); });
  }
  ~RawWaiter() {
    ended_ = true;
    end_.set_trigger_value(true);
    thread_.join();
  }
  RawWaiter(const RawWaiter&) = delete;
  RawWaiter& operator=(const RawWaiter&) = delete;

 private:
  void run() {
    eprosima::fastdds::dds::ConditionSeq active;
    Message message;
    eprosima::fastdds::dds::SampleInfo info;
    while (!ended_) {
      waits_.wait(active, eprosima::fastrtps::c_TimeInfinite);
      while (reader_->take_next_sample(&message, &info) ==
             eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
        if (info.valid_data) callback_(message);
      }
    }
  }

  eprosima::fastdds::dds::DataReader* reader_;
  std::function<void(const Message&)> callback_;
  eprosima::fastdds::dds::WaitSet waits_;
  eprosima::fastdds::dds::GuardCondition end_;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

}  // namespace coop::bench
