#include "runtime/dds_transport.hpp"

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/log/Log.hpp>
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
#include <sstream>
#include <stdexcept>

#include "runtime/dds_participant.hpp"
#include "runtime/dds_qos.hpp"

namespace coop::runtime {

namespace dds = eprosima::fastdds::dds;

struct DdsTransport::Impl {
  DdsOptions options;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::mutex mutex;
  std::map<std::string, dds::Topic*> topics;
  std::weak_ptr<std::function<void()>> match_callback;

  explicit Impl(const DdsOptions& wanted);
  ~Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  dds::Topic* topic(const std::string& name, const MessageType& type);
};

namespace {

[[noreturn]] void throw_dds(const std::string& what) {
  throw std::runtime_error("DDS: " + what);
}

std::string identity(const eprosima::fastrtps::rtps::GUID_t& guid) {
  std::ostringstream out;
  out << guid;
  return std::move(out).str();
}

/// The counterparts an endpoint is matched with at present. Told by listener threads.
class Matches {
 public:
  explicit Matches(std::weak_ptr<std::function<void()>> on_match)
      : on_match_(std::move(on_match)) {}
  void change(const dds::InstanceHandle_t& counterpart, int change) {
    eprosima::fastrtps::rtps::GUID_t guid;
    eprosima::fastrtps::rtps::iHandle2GUID(guid, counterpart);
    {
      const std::scoped_lock lock(mutex_);
      if (change > 0) {
        counterparts_.insert(identity(guid));
      } else {
        counterparts_.erase(identity(guid));
      }
    }
    if (const auto callback = on_match_.lock()) (*callback)();
  }
  [[nodiscard]] bool contains(const std::string& id) const {
    const std::scoped_lock lock(mutex_);
    return counterparts_.contains(id);
  }
  [[nodiscard]] int count() const {
    const std::scoped_lock lock(mutex_);
    return static_cast<int>(counterparts_.size());
  }

 private:
  std::weak_ptr<std::function<void()>> on_match_;
  mutable std::mutex mutex_;
  std::set<std::string> counterparts_;
};

class ReaderListener : public dds::DataReaderListener {
 public:
  ReaderListener(std::function<void()> on_data, std::weak_ptr<std::function<void()>> on_match)
      : matches(std::move(on_match)), on_data_(std::move(on_data)) {}
  void on_data_available(dds::DataReader*) override { on_data_(); }
  void on_subscription_matched(dds::DataReader*,
                               const dds::SubscriptionMatchedStatus& status) override {
    matches.change(status.last_publication_handle, status.current_count_change);
  }
  Matches matches;

 private:
  std::function<void()> on_data_;
};

class WriterListener : public dds::DataWriterListener {
 public:
  explicit WriterListener(std::weak_ptr<std::function<void()>> on_match)
      : matches(std::move(on_match)) {}
  void on_publication_matched(dds::DataWriter*,
                              const dds::PublicationMatchedStatus& status) override {
    matches.change(status.last_subscription_handle, status.current_count_change);
  }
  Matches matches;
};

std::uint64_t to_number(const eprosima::fastrtps::rtps::SequenceNumber_t& sequence) {
  return (static_cast<std::uint64_t>(sequence.high) << 32U) + sequence.low;
}

class DdsWriter : public Writer {
 public:
  template <class Impl>
  DdsWriter(const std::shared_ptr<Impl>& transport, dds::Topic* topic,
            const dds::DataWriterQos& qos)
      : transport_(transport),
        listener_(transport->match_callback),
        publisher_(transport->publisher),
        writer_(publisher_->create_datawriter(topic, qos, &listener_,
                                              dds::StatusMask::publication_matched())) {
    if (writer_ == nullptr) throw_dds("cannot create a writer of " + topic->get_name());
    id_ = identity(writer_->guid());
  }
  ~DdsWriter() override {
    writer_->set_listener(nullptr);
    publisher_->delete_datawriter(writer_);
  }
  DdsWriter(const DdsWriter&) = delete;
  DdsWriter& operator=(const DdsWriter&) = delete;

  const std::string& id() const override { return id_; }
  bool write(const void* message) override {
    // The signature takes a mutable pointer; the generated serialisers only read.
    if (!writer_->write(const_cast<void*>(message))) return false;
    ++sequence_;
    return true;
  }
  std::uint64_t sequence() const override { return sequence_; }
  int matched_readers() const override { return listener_.matches.count(); }
  bool reaches(const std::string& reader_id) const override {
    return listener_.matches.contains(reader_id);
  }
  bool wait_for_acknowledgments(Duration timeout) override {
    const auto nanoseconds = timeout.count();
    return writer_->wait_for_acknowledgments(eprosima::fastrtps::Duration_t(
               static_cast<std::int32_t>(nanoseconds / 1'000'000'000),
               static_cast<std::uint32_t>(nanoseconds % 1'000'000'000))) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }

 private:
  std::shared_ptr<void> transport_;  // keeps the participant while the writer lives
  WriterListener listener_;
  dds::Publisher* publisher_;
  dds::DataWriter* writer_;
  std::string id_;
  std::uint64_t sequence_ = 0;
};

class DdsReader : public Reader {
 public:
  template <class Impl>
  DdsReader(const std::shared_ptr<Impl>& transport, dds::Topic* topic, const MessageType& type,
            const dds::DataReaderQos& qos, std::function<void()> on_data)
      : transport_(transport),
        type_(type),
        listener_(std::move(on_data), transport->match_callback),
        subscriber_(transport->subscriber),
        reader_(subscriber_->create_datareader(topic, qos, &listener_,
                                               dds::StatusMask::data_available()
                                                   << dds::StatusMask::subscription_matched())) {
    if (reader_ == nullptr) throw_dds("cannot create a reader of " + topic->get_name());
    id_ = identity(reader_->guid());
  }
  ~DdsReader() override {
    reader_->set_listener(nullptr);
    subscriber_->delete_datareader(reader_);
  }
  DdsReader(const DdsReader&) = delete;
  DdsReader& operator=(const DdsReader&) = delete;

  const std::string& id() const override { return id_; }
  bool take(Sample& sample) override {
    std::shared_ptr<void> message = type_.create();
    dds::SampleInfo info;
    while (reader_->take_next_sample(message.get(), &info) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;  // only tells of a disposed or unregistered instance
      sample.message = std::move(message);
      sample.writer = writer_name(info.sample_identity.writer_guid());
      sample.sequence = to_number(info.sample_identity.sequence_number());
      return true;
    }
    return false;
  }
  int matched_writers() const override { return listener_.matches.count(); }
  bool hears(const std::string& writer_id) const override {
    return listener_.matches.contains(writer_id);
  }

 private:
  /// Most samples come from the writer of the sample before.
  const std::string& writer_name(const eprosima::fastrtps::rtps::GUID_t& guid) {
    if (last_writer_name_.empty() || guid != last_writer_) {
      last_writer_ = guid;
      last_writer_name_ = identity(guid);
    }
    return last_writer_name_;
  }

  std::shared_ptr<void> transport_;
  const MessageType& type_;
  ReaderListener listener_;
  dds::Subscriber* subscriber_;
  dds::DataReader* reader_;
  std::string id_;
  eprosima::fastrtps::rtps::GUID_t last_writer_;
  std::string last_writer_name_;
};

}  // namespace

DdsTransport::Impl::Impl(const DdsOptions& wanted)
    : options(wanted), participant(create_participant(wanted)) {
  dds::PublisherQos publisher_qos = participant->get_default_publisher_qos();
  dds::SubscriberQos subscriber_qos = participant->get_default_subscriber_qos();
  if (!options.partition.empty()) {
    publisher_qos.partition().push_back(options.partition.c_str());
    subscriber_qos.partition().push_back(options.partition.c_str());
  }
  publisher = participant->create_publisher(publisher_qos);
  subscriber = participant->create_subscriber(subscriber_qos);
  if (publisher == nullptr || subscriber == nullptr) throw_dds("cannot create endpoints");
}

DdsTransport::Impl::~Impl() {
  if (participant == nullptr) return;
  participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant);
}

dds::Topic* DdsTransport::Impl::topic(const std::string& name, const MessageType& type) {
  const std::scoped_lock lock(mutex);
  auto& entry = topics[name];
  if (entry == nullptr) {
    dds::TypeSupport support(type.new_dds_type());
    support.register_type(participant, type.name());
    entry = participant->create_topic("rt/" + name, type.name(), dds::TOPIC_QOS_DEFAULT);
  }
  if (entry == nullptr) throw_dds("cannot create topic " + name);
  if (entry->get_type_name() != type.name()) {
    throw_dds("topic " + name + " carries " + entry->get_type_name() + ", not " + type.name());
  }
  return entry;
}

DdsTransport::DdsTransport(const DdsOptions& options) : impl_(std::make_shared<Impl>(options)) {}
DdsTransport::~DdsTransport() = default;

std::unique_ptr<Writer> DdsTransport::create_writer(const std::string& topic,
                                                    const MessageType& type, Qos qos) {
  dds::DataWriterQos writer_qos = impl_->publisher->get_default_datawriter_qos();
  apply_intent(qos, impl_->options, writer_qos);
  return std::make_unique<DdsWriter>(impl_, impl_->topic(topic, type), writer_qos);
}

std::unique_ptr<Reader> DdsTransport::create_reader(const std::string& topic,
                                                    const MessageType& type, Qos qos,
                                                    std::function<void()> on_data) {
  dds::DataReaderQos reader_qos = impl_->subscriber->get_default_datareader_qos();
  apply_intent(qos, impl_->options, reader_qos);
  return std::make_unique<DdsReader>(impl_, impl_->topic(topic, type), type, reader_qos,
                                     std::move(on_data));
}

std::shared_ptr<void> DdsTransport::on_match(std::function<void()> callback) {
  auto kept = std::make_shared<std::function<void()>>(std::move(callback));
  impl_->match_callback = kept;
  return kept;
}

}  // namespace coop::runtime
