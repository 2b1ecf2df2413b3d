#include "runtime/dds_transport.hpp"

#include <fmt/format.h>

#include <deque>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <map>
#include <mutex>
#include <set>
#include <stdexcept>
#include <utility>

#include "runtime/dds_matches.hpp"
#include "runtime/dds_membership.hpp"
#include "runtime/dds_participant.hpp"
#include "runtime/dds_qos.hpp"
#include "runtime/pause_watch.hpp"
#include "runtime/server_watch.hpp"

namespace coop::runtime {

namespace dds = eprosima::fastdds::dds;

/// A membership that knows whether it sees its discovery server.
struct WatchedMembership {
  ServerWatch::Wall::time_point begin = ServerWatch::Wall::now();
  ServerWatch watch;
  Membership membership;

  WatchedMembership(const DdsOptions& options, std::function<void()> on_server)
      : watch(std::move(on_server)), membership(options, watch) {}
};

struct DdsTransport::Impl {
  DdsOptions options;
  bool is_served = options.settings.discovery == "server";
  /// A lockstep goes by the ids of its endpoints.
  bool may_join_anew = !options.complete;
  std::mutex endpoints_mutex;  ///< never held while Fast DDS is called
  std::set<DdsEndpoint*> endpoints;
  std::weak_ptr<std::function<void()>> match_callback;
  std::unique_ptr<WatchedMembership> present;
  /// Waits for the server while the other one has lost it.
  std::unique_ptr<WatchedMembership> successor;
  /// After which others have forgotten this program; until it has joined anew.
  std::optional<std::chrono::nanoseconds> pause;
  std::unique_ptr<PauseWatch> pause_watch;  // last: its thread nudges

  explicit Impl(const DdsOptions& wanted);
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  [[nodiscard]] Membership& membership() const { return present->membership; }
  std::unique_ptr<WatchedMembership> join();
  void add(DdsEndpoint& endpoint);
  void remove(DdsEndpoint& endpoint);
  void nudge();
  [[nodiscard]] bool has_successor();
  [[nodiscard]] bool has_served_successor();
  std::optional<std::string> mend();
};

namespace {

/// Of the server itself (config/dds/discovery_server.xml): after that it is known to be gone.
constexpr std::chrono::seconds kServerLease{2};
/// A server in reach is found sooner.
constexpr std::chrono::seconds kPatience{3};

[[noreturn]] void throw_dds(const std::string& what) {
  throw std::runtime_error("DDS: " + what);
}

std::uint64_t to_number(const eprosima::fastrtps::rtps::SequenceNumber_t& sequence) {
  return (static_cast<std::uint64_t>(sequence.high) << 32U) + sequence.low;
}

template <class Impl>
class DdsWriter : public Writer, private DdsEndpoint {
 public:
  DdsWriter(const std::shared_ptr<Impl>& transport, const std::string& topic,
            const MessageType& type, Qos intent)
      : transport_(transport),
        topic_(topic),
        type_(type),
        intent_(intent),
        listener_(transport->match_callback) {
    enter();
    transport_->add(*this);
  }
  ~DdsWriter() override {
    transport_->remove(*this);
    leave();
  }
  DdsWriter(const DdsWriter&) = delete;
  DdsWriter& operator=(const DdsWriter&) = delete;

  const std::string& id() const override { return id_; }
  bool write(const void* message) override {
    // The signature takes a mutable pointer; the generated serialisers only read.
    if (!writer_->write(const_cast<void*>(message))) return false;
    ++sequence_;
    if (keeps_last_) last_[type_.key_of(message)] = type_.clone(message);
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
  void enter() override {
    dds::Publisher& publisher = *transport_->membership().publisher;
    dds::DataWriterQos qos = publisher.get_default_datawriter_qos();
    apply_intent(intent_, transport_->options, qos);
    keeps_last_ =
        transport_->may_join_anew && qos.durability().kind == dds::TRANSIENT_LOCAL_DURABILITY_QOS;
    writer_ = publisher.create_datawriter(transport_->membership().topic("rt/" + topic_, type_),
                                          qos, &listener_, dds::StatusMask::publication_matched());
    if (writer_ == nullptr) throw_dds("cannot create a writer of " + topic_);
    id_ = identity(writer_->guid());
    sequence_ = 0;
    for (const auto& [key, message] : last_) {
      if (writer_->write(const_cast<void*>(message.get()))) ++sequence_;
    }
  }
  void leave() override {
    writer_->set_listener(nullptr);
    transport_->membership().publisher->delete_datawriter(writer_);
    listener_.matches.clear();
  }

  std::shared_ptr<Impl> transport_;  // keeps the participant while the writer lives
  std::string topic_;
  const MessageType& type_;
  Qos intent_;
  WriterListener listener_;
  dds::DataWriter* writer_ = nullptr;
  std::string id_;
  std::uint64_t sequence_ = 0;
  bool keeps_last_ = false;
  std::map<std::string, std::shared_ptr<const void>> last_;  ///< by key, for the next participant
};

template <class Impl>
class DdsReader : public Reader, private DdsEndpoint {
 public:
  DdsReader(const std::shared_ptr<Impl>& transport, const std::string& topic,
            const MessageType& type, Qos intent, std::function<void()> on_data)
      : transport_(transport),
        topic_(topic),
        type_(type),
        intent_(intent),
        on_data_(std::move(on_data)),
        listener_(on_data_, transport->match_callback) {
    enter();
    transport_->add(*this);
  }
  ~DdsReader() override {
    transport_->remove(*this);
    leave();
  }
  DdsReader(const DdsReader&) = delete;
  DdsReader& operator=(const DdsReader&) = delete;

  const std::string& id() const override { return id_; }
  bool take(Sample& sample) override {
    if (left_.empty()) return take_new(sample);
    sample = std::move(left_.front());
    left_.pop_front();
    return true;
  }
  int matched_writers() const override { return listener_.matches.count(); }
  bool hears(const std::string& writer_id) const override {
    return listener_.matches.contains(writer_id);
  }

 private:
  bool take_new(Sample& sample) {
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
  /// Most samples come from the writer of the sample before.
  const std::string& writer_name(const eprosima::fastrtps::rtps::GUID_t& guid) {
    if (last_writer_name_.empty() || guid != last_writer_) {
      last_writer_ = guid;
      last_writer_name_ = identity(guid);
    }
    return last_writer_name_;
  }

  void enter() override {
    dds::Subscriber& subscriber = *transport_->membership().subscriber;
    dds::DataReaderQos qos = subscriber.get_default_datareader_qos();
    apply_intent(intent_, transport_->options, qos);
    reader_ = subscriber.create_datareader(
        transport_->membership().topic("rt/" + topic_, type_), qos, &listener_,
        dds::StatusMask::data_available() << dds::StatusMask::subscription_matched());
    if (reader_ == nullptr) throw_dds("cannot create a reader of " + topic_);
    id_ = identity(reader_->guid());
  }
  void leave() override {
    reader_->set_listener(nullptr);
    for (Sample sample; take_new(sample);) left_.push_back(std::move(sample));
    if (!left_.empty()) on_data_();
    transport_->membership().subscriber->delete_datareader(reader_);
    listener_.matches.clear();
  }
  void nudge() override { on_data_(); }

  std::shared_ptr<Impl> transport_;
  std::string topic_;
  const MessageType& type_;
  Qos intent_;
  std::function<void()> on_data_;
  ReaderListener listener_;
  dds::DataReader* reader_ = nullptr;
  std::string id_;
  eprosima::fastrtps::rtps::GUID_t last_writer_;
  std::string last_writer_name_;
  std::deque<Sample> left_;  ///< not yet taken when the participant was left
};

}  // namespace

DdsTransport::Impl::Impl(const DdsOptions& wanted) : options(wanted), present(join()) {
  if (!may_join_anew) return;
  pause_watch = std::make_unique<PauseWatch>(forgotten_after(options.settings),
                                             run_out_after(options.settings), [this] { nudge(); });
}

std::unique_ptr<WatchedMembership> DdsTransport::Impl::join() {
  return std::make_unique<WatchedMembership>(options, [this] { nudge(); });
}

void DdsTransport::Impl::add(DdsEndpoint& endpoint) {
  const std::scoped_lock lock(endpoints_mutex);
  endpoints.insert(&endpoint);
}

void DdsTransport::Impl::remove(DdsEndpoint& endpoint) {
  const std::scoped_lock lock(endpoints_mutex);
  endpoints.erase(&endpoint);
}

void DdsTransport::Impl::nudge() {
  const std::scoped_lock lock(endpoints_mutex);
  for (DdsEndpoint* endpoint : endpoints) endpoint->nudge();
}

/// Whether there is one that can take over; makes it when it is due.
bool DdsTransport::Impl::has_successor() {
  if (is_served) return has_served_successor();
  if (pause) successor = join();
  return successor != nullptr;
}

bool DdsTransport::Impl::has_served_successor() {
  if (!successor) {
    const auto given_up = lease(options.settings) - kServerLease - kSignOfLife;
    if (pause || present->watch.has_lost_server(given_up)) successor = join();
    return false;
  }
  if (!pause && present->watch.sees_server()) {
    successor.reset();  // it had not been given up
    return false;
  }
  if (!successor->watch.sees_server()) {
    // One that was made while a cable was out does not use that interface later.
    if (ServerWatch::Wall::now() - successor->begin > kPatience) successor.reset();
    return false;
  }
  return true;
}

std::optional<std::string> DdsTransport::Impl::mend() {
  if (const auto seen = pause_watch ? pause_watch->take() : std::nullopt)
    pause = std::max(pause, seen);
  if (!may_join_anew || !has_successor()) return std::nullopt;
  for (DdsEndpoint* endpoint : endpoints) endpoint->leave();
  present = std::move(successor);
  for (DdsEndpoint* endpoint : endpoints) endpoint->enter();
  const auto ended = std::exchange(pause, std::nullopt);
  if (!ended) return "the discovery server was out of reach for too long: joined anew";
  return fmt::format("stopped for {:.1f} s: joined anew", to_seconds(*ended));
}

DdsTransport::DdsTransport(const DdsOptions& options) : impl_(std::make_shared<Impl>(options)) {}
DdsTransport::~DdsTransport() = default;

std::unique_ptr<Writer> DdsTransport::create_writer(const std::string& topic,
                                                    const MessageType& type, Qos qos) {
  return std::make_unique<DdsWriter<Impl>>(impl_, topic, type, qos);
}

std::unique_ptr<Reader> DdsTransport::create_reader(const std::string& topic,
                                                    const MessageType& type, Qos qos,
                                                    std::function<void()> on_data) {
  return std::make_unique<DdsReader<Impl>>(impl_, topic, type, qos, std::move(on_data));
}

std::shared_ptr<void> DdsTransport::on_match(std::function<void()> callback) {
  auto kept = std::make_shared<std::function<void()>>(std::move(callback));
  impl_->match_callback = kept;
  return kept;
}

std::optional<std::string> DdsTransport::mend() {
  return impl_->mend();
}

void DdsTransport::note_pause(Duration pause) {
  impl_->pause = pause;
}

}  // namespace coop::runtime
