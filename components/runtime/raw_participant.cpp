#include "runtime/raw_participant.hpp"

#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/PublisherQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/SubscriberQos.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "runtime/dds_participant.hpp"
#include "runtime/raw_qos.hpp"

namespace coop::runtime {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastrtps::types::ReturnCode_t;

namespace {

EndpointId id_of(const rtps::GUID_t& guid) {
  EndpointId id;
  std::memcpy(id.bytes.data(), guid.guidPrefix.value, 12);
  std::memcpy(id.bytes.data() + 12, guid.entityId.value, 4);
  return id;
}

Time to_time(const rtps::Time_t& time) {
  return Time(std::chrono::seconds(time.seconds()) + std::chrono::nanoseconds(time.nanosec()));
}

/// Notes discovery down; called by Fast DDS's threads.
class DiscoveryListener : public dds::DomainParticipantListener {
 public:
  explicit DiscoveryListener(std::function<void()> on_news) : on_news_(std::move(on_news)) {}

  void on_participant_discovery(dds::DomainParticipant*,
                                rtps::ParticipantDiscoveryInfo&& info) override {
    const std::scoped_lock lock(mutex_);
    const auto& prefix = info.info.m_guid.guidPrefix;
    if (info.status == rtps::ParticipantDiscoveryInfo::REMOVED_PARTICIPANT ||
        info.status == rtps::ParticipantDiscoveryInfo::DROPPED_PARTICIPANT) {
      names_.erase(prefix);
    } else {
      names_[prefix] = info.info.m_participantName.to_string();
    }
  }
  void on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) override {
    using Info = rtps::WriterDiscoveryInfo;
    note(info.status == Info::REMOVED_WRITER       ? DiscoveryEvent::Kind::kLost
         : info.status == Info::CHANGED_QOS_WRITER ? DiscoveryEvent::Kind::kChanged
                                                   : DiscoveryEvent::Kind::kFound,
         info.info, wire_qos_of(info.info.m_qos), true);
  }
  void on_subscriber_discovery(dds::DomainParticipant*, rtps::ReaderDiscoveryInfo&& info) override {
    using Info = rtps::ReaderDiscoveryInfo;
    note(info.status == Info::REMOVED_READER       ? DiscoveryEvent::Kind::kLost
         : info.status == Info::CHANGED_QOS_READER ? DiscoveryEvent::Kind::kChanged
                                                   : DiscoveryEvent::Kind::kFound,
         info.info, wire_qos_of(info.info.m_qos), false);
  }

  std::vector<DiscoveryEvent> take() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(events_, {});
  }

 private:
  template <class ProxyData>
  void note(DiscoveryEvent::Kind kind, const ProxyData& data, WireQos qos, bool is_writer) {
    {
      const std::scoped_lock lock(mutex_);
      const auto name = names_.find(data.guid().guidPrefix);
      events_.push_back({.kind = kind,
                         .endpoint = {.id = id_of(data.guid()),
                                      .is_writer = is_writer,
                                      .topic = {.name = data.topicName().to_string(),
                                                .type = data.typeName().to_string(),
                                                .keyed = data.topicKind() == rtps::WITH_KEY},
                                      .qos = std::move(qos),
                                      .participant = name == names_.end() ? "" : name->second}});
    }
    on_news_();
  }

  std::function<void()> on_news_;
  std::mutex mutex_;
  std::map<rtps::GuidPrefix_t, std::string> names_;
  std::vector<DiscoveryEvent> events_;
};

/// The counterparts of an endpoint.
class Counterparts {
 public:
  explicit Counterparts(const std::function<void()>& on_news) : on_news_(on_news) {}
  void change(const dds::InstanceHandle_t& handle, int change) {
    rtps::GUID_t guid;
    rtps::iHandle2GUID(guid, handle);
    {
      const std::scoped_lock lock(mutex_);
      if (change > 0) ids_.insert(id_of(guid));
      if (change < 0) ids_.erase(id_of(guid));
    }
    on_news_();
  }
  [[nodiscard]] int count() const {
    const std::scoped_lock lock(mutex_);
    return static_cast<int>(ids_.size());
  }
  [[nodiscard]] bool contains(const EndpointId& id) const {
    const std::scoped_lock lock(mutex_);
    return ids_.contains(id);
  }

 private:
  const std::function<void()>& on_news_;
  mutable std::mutex mutex_;
  std::set<EndpointId> ids_;
};

class DdsRawReader : public RawReader, private dds::DataReaderListener {
 public:
  DdsRawReader(dds::Subscriber& subscriber, dds::Topic* topic, const dds::DataReaderQos& qos,
               const std::function<void()>& on_news, std::function<void(RawSample&&)> on_sample)
      : counterparts_(on_news), on_sample_(std::move(on_sample)), subscriber_(subscriber) {
    reader_ = subscriber_.create_datareader(topic, qos, this,
                                            dds::StatusMask::data_available()
                                                << dds::StatusMask::subscription_matched());
    if (reader_ == nullptr) {
      throw std::runtime_error("DDS: cannot create a reader of " + topic->get_name());
    }
  }
  ~DdsRawReader() override {
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }
  DdsRawReader(const DdsRawReader&) = delete;
  DdsRawReader& operator=(const DdsRawReader&) = delete;
  [[nodiscard]] int matched_writers() const override { return counterparts_.count(); }
  [[nodiscard]] bool hears(const EndpointId& writer) const override {
    return counterparts_.contains(writer);
  }

 private:
  void on_subscription_matched(dds::DataReader*,
                               const dds::SubscriptionMatchedStatus& status) override {
    counterparts_.change(status.last_publication_handle, status.current_count_change);
  }
  void on_data_available(dds::DataReader* reader) override {
    RawSample sample;
    dds::SampleInfo info;
    while (reader->take_next_sample(&sample.bytes, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;  // only tells of a disposed or unregistered instance
      const auto& number = info.sample_identity.sequence_number();
      sample.writer = id_of(info.sample_identity.writer_guid());
      sample.sequence = (static_cast<std::uint64_t>(number.high) << 32U) + number.low;
      sample.source_time = to_time(info.source_timestamp);
      sample.reception_time = to_time(info.reception_timestamp);
      on_sample_(std::move(sample));
      sample.bytes.clear();
    }
  }

  Counterparts counterparts_;
  std::function<void(RawSample&&)> on_sample_;
  dds::Subscriber& subscriber_;
  dds::DataReader* reader_ = nullptr;
};

class DdsRawWriter : public RawWriter, private dds::DataWriterListener {
 public:
  DdsRawWriter(dds::Publisher& publisher, dds::Topic* topic, const dds::DataWriterQos& qos,
               const std::function<void()>& on_news)
      : counterparts_(on_news), publisher_(publisher) {
    writer_ =
        publisher_.create_datawriter(topic, qos, this, dds::StatusMask::publication_matched());
    if (writer_ == nullptr) {
      throw std::runtime_error("DDS: cannot create a writer of " + topic->get_name());
    }
  }
  ~DdsRawWriter() override {
    writer_->set_listener(nullptr);
    publisher_.delete_datawriter(writer_);
  }
  DdsRawWriter(const DdsRawWriter&) = delete;
  DdsRawWriter& operator=(const DdsRawWriter&) = delete;
  [[nodiscard]] EndpointId id() const override { return id_of(writer_->guid()); }
  bool write(const std::vector<std::uint8_t>& bytes) override {
    return writer_->write(const_cast<std::vector<std::uint8_t>*>(&bytes));
  }
  [[nodiscard]] int matched_readers() const override { return counterparts_.count(); }
  bool wait_for_acknowledgments(Duration timeout) override {
    return writer_->wait_for_acknowledgments(to_dds(timeout)) == ReturnCode_t::RETCODE_OK;
  }

 private:
  void on_publication_matched(dds::DataWriter*,
                              const dds::PublicationMatchedStatus& status) override {
    counterparts_.change(status.last_subscription_handle, status.current_count_change);
  }

  Counterparts counterparts_;
  dds::Publisher& publisher_;
  dds::DataWriter* writer_ = nullptr;
};

}  // namespace

struct RawParticipant::Impl {
  std::function<void()> on_news;
  DiscoveryListener listener;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::map<std::string, dds::Topic*> topics;

  explicit Impl(std::function<void()> told) : on_news(std::move(told)), listener(on_news) {}

  dds::Topic* topic(const WireTopic& wanted) {
    auto& entry = topics[wanted.name];
    if (entry == nullptr) {
      if (participant->find_type(wanted.type) == nullptr) {
        dds::TypeSupport support(RawMessageType(wanted.type, wanted.keyed).new_dds_type());
        support.register_type(participant);
      }
      entry = participant->create_topic(wanted.name, wanted.type, dds::TOPIC_QOS_DEFAULT);
    }
    if (entry == nullptr) throw std::runtime_error("DDS: cannot create topic " + wanted.name);
    if (entry->get_type_name() != wanted.type) {
      throw std::runtime_error("topic " + wanted.name + " carries " + entry->get_type_name() +
                               " and " + wanted.type);
    }
    return entry;
  }
};

RawParticipant::RawParticipant(const DdsOptions& options, std::function<void()> on_news)
    : impl_(std::make_unique<Impl>(std::move(on_news))) {
  impl_->participant = create_participant(options, &impl_->listener);
  dds::PublisherQos publisher_qos = impl_->participant->get_default_publisher_qos();
  dds::SubscriberQos subscriber_qos = impl_->participant->get_default_subscriber_qos();
  if (!options.partition.empty()) {
    publisher_qos.partition().push_back(options.partition.c_str());
    subscriber_qos.partition().push_back(options.partition.c_str());
  }
  impl_->publisher = impl_->participant->create_publisher(publisher_qos);
  impl_->subscriber = impl_->participant->create_subscriber(subscriber_qos);
  if (impl_->publisher == nullptr || impl_->subscriber == nullptr) {
    throw std::runtime_error("DDS: cannot create endpoints");
  }
}

RawParticipant::~RawParticipant() {
  if (impl_->participant == nullptr) return;
  impl_->participant->set_listener(nullptr);
  impl_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(impl_->participant);
}

std::vector<DiscoveryEvent> RawParticipant::take_events() {
  return impl_->listener.take();
}

std::unique_ptr<RawReader> RawParticipant::create_reader(
    const WireTopic& topic, const WireQos& qos, std::function<void(RawSample&&)> on_sample) {
  dds::DataReaderQos reader_qos = impl_->subscriber->get_default_datareader_qos();
  apply(qos, reader_qos);
  return std::make_unique<DdsRawReader>(*impl_->subscriber, impl_->topic(topic), reader_qos,
                                        impl_->on_news, std::move(on_sample));
}

std::unique_ptr<RawWriter> RawParticipant::create_writer(const WireTopic& topic,
                                                         const WireQos& qos) {
  dds::DataWriterQos writer_qos = impl_->publisher->get_default_datawriter_qos();
  apply(qos, writer_qos);
  return std::make_unique<DdsRawWriter>(*impl_->publisher, impl_->topic(topic), writer_qos,
                                        impl_->on_news);
}

WireQos reader_for(const WireQos& offered) {
  WireQos wanted;
  wanted.reliable = offered.reliable;
  wanted.transient_local = offered.transient_local && offered.reliable;
  wanted.keep_all = true;
  return wanted;
}

}  // namespace coop::runtime
