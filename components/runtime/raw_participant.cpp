#include "runtime/raw_participant.hpp"

#include <cstring>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "runtime/dds_membership.hpp"
#include "runtime/dds_participant.hpp"
#include "runtime/pause_watch.hpp"
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
  /// All are lost: the participant that knew them is gone.
  void lose_all() {
    const std::scoped_lock lock(mutex_);
    for (auto& [id, endpoint] : known_) {
      events_.push_back({DiscoveryEvent::Kind::kLost, std::move(endpoint)});
    }
    known_.clear();
    names_.clear();
  }

 private:
  template <class ProxyData>
  void note(DiscoveryEvent::Kind kind, const ProxyData& data, const WireQos& qos, bool is_writer) {
    {
      const std::scoped_lock lock(mutex_);
      const auto name = names_.find(data.guid().guidPrefix);
      DiscoveredEndpoint endpoint{.id = id_of(data.guid()),
                                  .is_writer = is_writer,
                                  .topic = {.name = data.topicName().to_string(),
                                            .type = data.typeName().to_string(),
                                            .keyed = data.topicKind() == rtps::WITH_KEY},
                                  .qos = qos,
                                  .participant = name == names_.end() ? "" : name->second};
      if (kind == DiscoveryEvent::Kind::kLost) {
        known_.erase(endpoint.id);
      } else {
        known_[endpoint.id] = endpoint;
      }
      events_.push_back({kind, std::move(endpoint)});
    }
    on_news_();
  }

  std::function<void()> on_news_;
  std::mutex mutex_;
  std::map<rtps::GuidPrefix_t, std::string> names_;
  std::map<EndpointId, DiscoveredEndpoint> known_;
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
  void clear() {
    const std::scoped_lock lock(mutex_);
    ids_.clear();
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

/// What endpoints need of the participant they are in.
struct Seat {
  std::function<void()> on_news;
  std::unique_ptr<Membership> membership;
  std::set<DdsEndpoint*> endpoints;

  dds::Topic* topic(const WireTopic& wanted) const {
    return membership->topic(wanted.name, RawMessageType(wanted.type, wanted.keyed));
  }
};

class DdsRawReader : public RawReader, private DdsEndpoint, private dds::DataReaderListener {
 public:
  DdsRawReader(Seat& seat, WireTopic topic, WireQos qos, std::function<void(RawSample&&)> on_sample)
      : seat_(seat),
        topic_(std::move(topic)),
        qos_(std::move(qos)),
        counterparts_(seat.on_news),
        on_sample_(std::move(on_sample)) {
    enter();
    seat_.endpoints.insert(this);
  }
  ~DdsRawReader() override {
    seat_.endpoints.erase(this);
    leave();
  }
  DdsRawReader(const DdsRawReader&) = delete;
  DdsRawReader& operator=(const DdsRawReader&) = delete;
  [[nodiscard]] int matched_writers() const override { return counterparts_.count(); }
  [[nodiscard]] bool hears(const EndpointId& writer) const override {
    return counterparts_.contains(writer);
  }

 private:
  void enter() override {
    dds::Subscriber& subscriber = *seat_.membership->subscriber;
    dds::DataReaderQos qos = subscriber.get_default_datareader_qos();
    apply(qos_, qos);
    reader_ = subscriber.create_datareader(seat_.topic(topic_), qos, this,
                                           dds::StatusMask::data_available()
                                               << dds::StatusMask::subscription_matched());
    if (reader_ == nullptr) {
      throw std::runtime_error("DDS: cannot create a reader of " + topic_.name);
    }
  }
  void leave() override {
    reader_->set_listener(nullptr);
    seat_.membership->subscriber->delete_datareader(reader_);
    counterparts_.clear();
  }
  void on_subscription_matched(dds::DataReader*,
                               const dds::SubscriptionMatchedStatus& status) override {
    counterparts_.change(status.last_publication_handle, status.current_count_change);
  }
  void on_data_available(dds::DataReader* reader) override {
    while (true) {
      RawSample sample;
      dds::SampleInfo info;
      if (reader->take_next_sample(&sample.bytes, &info) != ReturnCode_t::RETCODE_OK) return;
      if (!info.valid_data) continue;  // only tells of a disposed or unregistered instance
      const auto& number = info.sample_identity.sequence_number();
      sample.writer = id_of(info.sample_identity.writer_guid());
      sample.sequence = (static_cast<std::uint64_t>(number.high) << 32U) + number.low;
      sample.source_time = to_time(info.source_timestamp);
      sample.reception_time = to_time(info.reception_timestamp);
      on_sample_(std::move(sample));
    }
  }

  Seat& seat_;
  WireTopic topic_;
  WireQos qos_;
  Counterparts counterparts_;
  std::function<void(RawSample&&)> on_sample_;
  dds::DataReader* reader_ = nullptr;
};

class DdsRawWriter : public RawWriter, private DdsEndpoint, private dds::DataWriterListener {
 public:
  DdsRawWriter(Seat& seat, WireTopic topic, WireQos qos)
      : seat_(seat), topic_(std::move(topic)), qos_(std::move(qos)), counterparts_(seat.on_news) {
    enter();
    seat_.endpoints.insert(this);
  }
  ~DdsRawWriter() override {
    seat_.endpoints.erase(this);
    leave();
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
  void enter() override {
    dds::Publisher& publisher = *seat_.membership->publisher;
    dds::DataWriterQos qos = publisher.get_default_datawriter_qos();
    apply(qos_, qos);
    writer_ = publisher.create_datawriter(seat_.topic(topic_), qos, this,
                                          dds::StatusMask::publication_matched());
    if (writer_ == nullptr) {
      throw std::runtime_error("DDS: cannot create a writer of " + topic_.name);
    }
  }
  void leave() override {
    writer_->set_listener(nullptr);
    seat_.membership->publisher->delete_datawriter(writer_);
    counterparts_.clear();
  }
  void on_publication_matched(dds::DataWriter*,
                              const dds::PublicationMatchedStatus& status) override {
    counterparts_.change(status.last_subscription_handle, status.current_count_change);
  }

  Seat& seat_;
  WireTopic topic_;
  WireQos qos_;
  Counterparts counterparts_;
  dds::DataWriter* writer_ = nullptr;
};

}  // namespace

struct RawParticipant::Impl {
  DdsOptions options;
  DiscoveryListener listener;
  Seat seat;
  PauseWatch pause_watch;

  Impl(DdsOptions wanted, const std::function<void()>& on_news)
      : options(std::move(wanted)),
        listener(on_news),
        seat{on_news, std::make_unique<Membership>(options, listener), {}},
        pause_watch(forgotten_after(options.settings), run_out_after(options.settings), on_news) {}
};

RawParticipant::RawParticipant(const DdsOptions& options, const std::function<void()>& on_news)
    : impl_(std::make_unique<Impl>(options, on_news)) {}
RawParticipant::~RawParticipant() = default;

std::vector<DiscoveryEvent> RawParticipant::take_events() {
  return impl_->listener.take();
}

bool RawParticipant::mend() {
  if (!impl_->pause_watch.take()) return false;
  join_anew();
  return true;
}

void RawParticipant::join_anew() {
  for (DdsEndpoint* endpoint : impl_->seat.endpoints) endpoint->leave();
  impl_->seat.membership.reset();
  impl_->listener.lose_all();
  impl_->seat.membership = std::make_unique<Membership>(impl_->options, impl_->listener);
  for (DdsEndpoint* endpoint : impl_->seat.endpoints) endpoint->enter();
}

std::unique_ptr<RawReader> RawParticipant::create_reader(
    const WireTopic& topic, const WireQos& qos, std::function<void(RawSample&&)> on_sample) {
  return std::make_unique<DdsRawReader>(impl_->seat, topic, qos, std::move(on_sample));
}

std::unique_ptr<RawWriter> RawParticipant::create_writer(const WireTopic& topic,
                                                         const WireQos& qos) {
  return std::make_unique<DdsRawWriter>(impl_->seat, topic, qos);
}

WireQos reader_for(const WireQos& offered) {
  WireQos wanted;
  wanted.reliable = offered.reliable;
  wanted.transient_local = offered.transient_local && offered.reliable;
  wanted.keep_all = true;
  return wanted;
}

}  // namespace coop::runtime
