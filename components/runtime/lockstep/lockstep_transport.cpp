#include "runtime/lockstep/lockstep_transport.hpp"

#include <algorithm>
#include <atomic>
#include <map>
#include <stdexcept>

#include "runtime/lockstep/sample_gate.hpp"

namespace coop::runtime {

using coop_msgs::msg::LockstepEndpoint;
using coop_msgs::msg::LockstepMark;
using coop_msgs::msg::LockstepMember;
using coop_msgs::msg::LockstepRoster;
namespace EndpointKind = coop_msgs::msg::LockstepEndpoint_Constants;

namespace {

bool is_latched(Qos qos) {
  return qos == Qos::kStateLatched;
}

}  // namespace

/// What readers and writers share with the transport that made them; they may outlive it.
struct LockstepTransport::Shared {
  struct WriterEntry {
    Writer* writer = nullptr;  ///< null once it is gone
    std::uint64_t reported = 0;
  };
  struct ReaderEntry {
    GatedReader* gated = nullptr;  ///< null for control readers and once it is gone
    Reader* reader = nullptr;
    bool patient = false;
  };
  struct Endpoint {
    std::string topic;
    std::string id;
    bool latched = false;
    bool is_control = false;
    bool is_writer = false;
    WriterEntry writer;
    ReaderEntry reader;
  };

  Transport& carrier;
  std::string component;
  SampleTrace* trace;
  bool described = false;
  std::vector<Endpoint> endpoints;
  /// Of the roster: what a mark speaks of, by member and endpoint.
  struct Marked {
    WriterRank rank;
    std::vector<GatedReader*> readers;
  };
  std::vector<std::vector<Marked>> marked;
  std::atomic<bool> hungry = false;  ///< arriving samples wake the component

  Shared(Transport& transport, std::string name, SampleTrace* samples)
      : carrier(transport), component(std::move(name)), trace(samples) {}

  std::size_t add(Endpoint endpoint) {
    if (described) {
      throw std::logic_error("topic " + endpoint.topic +
                             ": in lockstep all writers and readers are made at the start");
    }
    endpoints.push_back(std::move(endpoint));
    return endpoints.size() - 1;
  }
};

class LockstepTransport::GatedReader : public Reader {
 public:
  GatedReader(std::shared_ptr<Shared> shared, const std::string& topic, const MessageType& type,
              Qos qos, const std::function<void()>& on_data)
      : shared_(std::move(shared)),
        gate_(type, is_latched(qos)),
        reader_(
            shared_->carrier.create_reader(topic, type, qos, [hungry = &shared_->hungry, on_data] {
              if (hungry->load()) on_data();
            })) {
    index_ = shared_->add({.topic = topic,
                           .id = reader_->id(),
                           .latched = is_latched(qos),
                           .writer = {},
                           .reader = {.gated = this, .reader = reader_.get()}});
  }
  ~GatedReader() override { shared_->endpoints[index_].reader = {}; }
  GatedReader(const GatedReader&) = delete;
  GatedReader& operator=(const GatedReader&) = delete;

  const std::string& id() const override { return reader_->id(); }
  bool take(Sample& sample) override { return gate_.next(sample); }
  int matched_writers() const override { return reader_->matched_writers(); }
  bool hears(const std::string& writer_id) const override { return reader_->hears(writer_id); }
  void be_patient() override { shared_->endpoints[index_].reader.patient = true; }

  void collect() {
    Sample sample;
    while (reader_->take(sample)) gate_.hold(std::move(sample));
  }
  SampleGate& gate() { return gate_; }
  std::uint64_t outside_told = 0;

 private:
  std::shared_ptr<Shared> shared_;
  SampleGate gate_;
  std::unique_ptr<Reader> reader_;
  std::size_t index_ = 0;
};

class LockstepTransport::CountedWriter : public Writer {
 public:
  CountedWriter(std::shared_ptr<Shared> shared, const std::string& topic, const MessageType& type,
                Qos qos)
      : shared_(std::move(shared)),
        type_(type),
        writer_(shared_->carrier.create_writer(topic, type, qos)) {
    index_ = shared_->add({.topic = topic,
                           .id = writer_->id(),
                           .latched = is_latched(qos),
                           .is_writer = true,
                           .writer = {.writer = writer_.get()},
                           .reader = {}});
  }
  ~CountedWriter() override { shared_->endpoints[index_].writer.writer = nullptr; }
  CountedWriter(const CountedWriter&) = delete;
  CountedWriter& operator=(const CountedWriter&) = delete;

  const std::string& id() const override { return writer_->id(); }
  bool write(const void* message) override {
    if (!writer_->write(message)) {
      throw std::runtime_error("lockstep: topic " + topic() +
                               ": a reader does not take its samples");
    }
    if (shared_->trace != nullptr) {
      shared_->trace->record(topic(), writer_->sequence(), type_, message);
    }
    return true;
  }
  std::uint64_t sequence() const override { return writer_->sequence(); }
  int matched_readers() const override { return writer_->matched_readers(); }
  bool reaches(const std::string& reader_id) const override { return writer_->reaches(reader_id); }
  bool wait_for_acknowledgments(Duration timeout) override {
    return writer_->wait_for_acknowledgments(timeout);
  }

 private:
  [[nodiscard]] const std::string& topic() const { return shared_->endpoints[index_].topic; }

  std::shared_ptr<Shared> shared_;
  const MessageType& type_;
  std::unique_ptr<Writer> writer_;
  std::size_t index_ = 0;
};

LockstepTransport::LockstepTransport(Transport& carrier, std::string component, SampleTrace* trace)
    : shared_(std::make_shared<Shared>(carrier, std::move(component), trace)) {}
LockstepTransport::~LockstepTransport() = default;

std::unique_ptr<Writer> LockstepTransport::create_writer(const std::string& topic,
                                                         const MessageType& type, Qos qos) {
  if (qos == Qos::kHeartbeat) return shared_->carrier.create_writer(topic, type, qos);
  return std::make_unique<CountedWriter>(shared_, topic, type, qos);
}

std::unique_ptr<Reader> LockstepTransport::create_reader(const std::string& topic,
                                                         const MessageType& type, Qos qos,
                                                         std::function<void()> on_data) {
  if (qos == Qos::kHeartbeat) {
    return shared_->carrier.create_reader(topic, type, qos, std::move(on_data));
  }
  return std::make_unique<GatedReader>(shared_, topic, type, qos, on_data);
}

std::shared_ptr<void> LockstepTransport::on_match(std::function<void()> callback) {
  return shared_->carrier.on_match(std::move(callback));
}

std::unique_ptr<Writer> LockstepTransport::create_control_writer(const std::string& topic,
                                                                 const MessageType& type) {
  auto writer = shared_->carrier.create_writer(topic, type, Qos::kEvent);
  shared_->add({.topic = topic,
                .id = writer->id(),
                .is_control = true,
                .is_writer = true,
                .writer = {.writer = writer.get()},
                .reader = {}});
  return writer;
}

std::unique_ptr<Reader> LockstepTransport::create_control_reader(const std::string& topic,
                                                                 const MessageType& type,
                                                                 std::function<void()> on_data) {
  auto reader = shared_->carrier.create_reader(topic, type, Qos::kEvent, std::move(on_data));
  shared_->add({.topic = topic,
                .id = reader->id(),
                .is_control = true,
                .writer = {},
                .reader = {.gated = nullptr, .reader = reader.get()}});
  return reader;
}

LockstepMember LockstepTransport::describe(std::uint64_t incarnation) {
  shared_->described = true;
  LockstepMember member;
  member.name(shared_->component);
  member.incarnation(incarnation);
  for (Shared::Endpoint& endpoint : shared_->endpoints) {
    LockstepEndpoint message;
    message.topic(endpoint.topic);
    message.id(endpoint.id);
    message.kind(endpoint.is_writer ? EndpointKind::WRITER : EndpointKind::READER);
    message.latched(endpoint.latched);
    message.patient(endpoint.reader.patient);
    if (endpoint.writer.writer != nullptr && !endpoint.is_control) {
      endpoint.writer.reported = endpoint.writer.writer->sequence();
      message.sequence_number(endpoint.writer.reported);
    }
    member.endpoints().push_back(std::move(message));
  }
  return member;
}

bool LockstepTransport::is_matched(const LockstepRoster& roster) const {
  for (const Shared::Endpoint& own : shared_->endpoints) {
    const auto other_kind = own.is_writer ? EndpointKind::READER : EndpointKind::WRITER;
    for (const LockstepMember& member : roster.members()) {
      for (const LockstepEndpoint& other : member.endpoints()) {
        if (other.kind() != other_kind || other.topic() != own.topic) continue;
        const bool matched =
            own.is_writer ? own.writer.writer == nullptr || own.writer.writer->reaches(other.id())
                          : own.reader.reader == nullptr || own.reader.reader->hears(other.id());
        if (!matched) return false;
      }
    }
  }
  return true;
}

void LockstepTransport::adopt(const LockstepRoster& roster) {
  std::vector<std::string> ids;
  for (const LockstepMember& member : roster.members()) {
    for (const LockstepEndpoint& endpoint : member.endpoints()) ids.push_back(endpoint.id());
  }
  for (const Shared::Endpoint& own : shared_->endpoints) {
    if (own.reader.gated == nullptr) continue;
    own.reader.gated->collect();
    own.reader.gated->gate().keep_only(ids);
  }
  shared_->marked.clear();
  for (const LockstepMember& member : roster.members()) {
    auto& marked = shared_->marked.emplace_back();
    for (const LockstepEndpoint& endpoint : member.endpoints()) {
      const WriterRank rank{member.name(), static_cast<std::uint32_t>(marked.size())};
      auto& mark = marked.emplace_back(Shared::Marked{rank, {}});
      if (endpoint.kind() != EndpointKind::WRITER) continue;
      for (const Shared::Endpoint& own : shared_->endpoints) {
        if (own.reader.gated == nullptr || own.topic != endpoint.topic()) continue;
        own.reader.gated->gate().admit(endpoint.id(), rank, endpoint.sequence_number());
        mark.readers.push_back(own.reader.gated);
      }
    }
  }
}

void LockstepTransport::expect(const LockstepMark& mark) {
  const auto& marked = shared_->marked.at(mark.member()).at(mark.endpoint());
  for (GatedReader* reader : marked.readers)
    reader->gate().expect(marked.rank, mark.sequence_number());
}

bool LockstepTransport::collect() {
  // Hungry before the last look: what arrives after it finds the component awake.
  shared_->hungry = true;
  bool complete = true;
  for (const Shared::Endpoint& own : shared_->endpoints) {
    if (own.reader.gated == nullptr) continue;
    own.reader.gated->collect();
    complete = complete && own.reader.gated->gate().is_complete();
  }
  if (complete) shared_->hungry = false;
  return complete;
}

std::string LockstepTransport::missing() const {
  for (const Shared::Endpoint& own : shared_->endpoints) {
    if (own.reader.gated == nullptr || own.reader.gated->gate().is_complete()) continue;
    return own.topic + ": " + own.reader.gated->gate().missing();
  }
  return {};
}

void LockstepTransport::forgo_missing() {
  for (const Shared::Endpoint& own : shared_->endpoints) {
    if (own.reader.gated != nullptr) own.reader.gated->gate().forgo_missing();
  }
}

void LockstepTransport::release(std::uint64_t tick) {
  if (shared_->trace != nullptr) shared_->trace->begin_tick(tick);
  for (const Shared::Endpoint& own : shared_->endpoints) {
    if (own.reader.gated != nullptr) own.reader.gated->gate().release();
  }
}

std::vector<std::string> LockstepTransport::take_outside_topics() {
  std::vector<std::string> topics;
  for (const Shared::Endpoint& own : shared_->endpoints) {
    if (own.reader.gated == nullptr) continue;
    const std::uint64_t count = own.reader.gated->gate().from_outside();
    if (count > own.reader.gated->outside_told) topics.push_back(own.topic);
    own.reader.gated->outside_told = count;
  }
  return topics;
}

std::vector<LockstepMark> LockstepTransport::take_published() {
  std::vector<LockstepMark> marks;
  for (std::size_t i = 0; i < shared_->endpoints.size(); ++i) {
    Shared::Endpoint& own = shared_->endpoints[i];
    if (own.writer.writer == nullptr || own.is_control) continue;
    const std::uint64_t sequence = own.writer.writer->sequence();
    if (sequence == own.writer.reported) continue;
    own.writer.reported = sequence;
    LockstepMark mark;
    mark.endpoint(static_cast<std::uint32_t>(i));
    mark.sequence_number(sequence);
    marks.push_back(mark);
  }
  return marks;
}

}  // namespace coop::runtime
