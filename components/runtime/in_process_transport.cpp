#include "runtime/in_process_transport.hpp"

#include <algorithm>
#include <deque>
#include <stdexcept>
#include <vector>

namespace coop::runtime {

struct InProcessTransport::Topic {
  std::string name;
  const MessageType* type = nullptr;
  std::vector<BusReader*> readers;
  std::vector<std::string> writers;
  /// Last sample a (writer, key) of latched writers, in order of first appearance.
  std::vector<std::pair<std::string, Sample>> latched;
};

struct InProcessTransport::Bus {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<Topic>> topics;
  std::vector<std::weak_ptr<std::function<void()>>> match_callbacks;
  bool complete = false;
  int endpoints_ever = 0;

  /// With the mutex locked.
  std::string new_id(const char* kind) { return kind + std::to_string(++endpoints_ever); }
  /// Without: the callback may look at endpoints.
  void tell_match() {
    std::vector<std::shared_ptr<std::function<void()>>> callbacks;
    {
      const std::scoped_lock lock(mutex);
      std::erase_if(match_callbacks, [](const auto& callback) { return callback.expired(); });
      for (const auto& callback : match_callbacks) callbacks.push_back(callback.lock());
    }
    for (const auto& callback : callbacks) {
      if (callback) (*callback)();
    }
  }
};

class InProcessTransport::BusReader : public Reader {
 public:
  BusReader(std::shared_ptr<Bus> bus, std::shared_ptr<Topic> topic, Qos qos,
            std::function<void()> on_data)
      : bus_(std::move(bus)), topic_(std::move(topic)), qos_(qos), on_data_(std::move(on_data)) {
    {
      const std::scoped_lock lock(bus_->mutex);
      id_ = bus_->new_id("reader");
      topic_->readers.push_back(this);
      if (is_latched(qos_)) {
        for (const auto& [key, sample] : topic_->latched) queue_.push_back(sample);
      }
      if (!queue_.empty()) on_data_();
    }
    bus_->tell_match();
  }
  ~BusReader() override {
    const std::scoped_lock lock(bus_->mutex);
    std::erase(topic_->readers, this);
  }
  const std::string& id() const override { return id_; }
  bool take(Sample& sample) override {
    const std::scoped_lock lock(bus_->mutex);
    if (queue_.empty()) return false;
    sample = std::move(queue_.front());
    queue_.pop_front();
    return true;
  }
  int matched_writers() const override {
    const std::scoped_lock lock(bus_->mutex);
    return static_cast<int>(topic_->writers.size());
  }
  bool hears(const std::string& writer_id) const override {
    const std::scoped_lock lock(bus_->mutex);
    return std::ranges::find(topic_->writers, writer_id) != topic_->writers.end();
  }
  /// With the bus locked.
  void deliver(const Sample& sample) {
    queue_.push_back(sample);
    const std::size_t depth = bus_->complete               ? 2000U
                              : qos_ == Qos::kSensorStream ? 5U
                              : qos_ == Qos::kCommand      ? 1U
                                                           : 2000U;
    while (queue_.size() > depth) queue_.pop_front();
    on_data_();
  }
  static bool is_latched(Qos qos) { return qos == Qos::kStateLatched || qos == Qos::kHeartbeat; }

 private:
  std::shared_ptr<Bus> bus_;
  std::shared_ptr<Topic> topic_;
  Qos qos_;
  std::function<void()> on_data_;
  std::string id_;
  std::deque<Sample> queue_;
};

class InProcessTransport::BusWriter : public Writer {
 public:
  BusWriter(std::shared_ptr<Bus> bus, std::shared_ptr<Topic> topic, Qos qos)
      : bus_(std::move(bus)), topic_(std::move(topic)), qos_(qos) {
    {
      const std::scoped_lock lock(bus_->mutex);
      id_ = bus_->new_id("writer");
      topic_->writers.push_back(id_);
    }
    bus_->tell_match();
  }
  ~BusWriter() override {
    const std::scoped_lock lock(bus_->mutex);
    std::erase(topic_->writers, id_);
    std::erase_if(topic_->latched,
                  [this](const auto& entry) { return entry.second.writer == id_; });
  }
  const std::string& id() const override { return id_; }
  bool write(const void* message) override {
    const Sample sample{topic_->type->clone(message), id_, ++sequence_};
    const std::scoped_lock lock(bus_->mutex);
    if (BusReader::is_latched(qos_)) latch(id_ + topic_->type->key_of(message), sample);
    for (BusReader* reader : topic_->readers) reader->deliver(sample);
    return true;
  }
  std::uint64_t sequence() const override { return sequence_; }
  int matched_readers() const override {
    const std::scoped_lock lock(bus_->mutex);
    return static_cast<int>(topic_->readers.size());
  }
  bool reaches(const std::string& reader_id) const override {
    const std::scoped_lock lock(bus_->mutex);
    return std::ranges::any_of(topic_->readers,
                               [&](const BusReader* reader) { return reader->id() == reader_id; });
  }
  bool wait_for_acknowledgments(Duration) override { return true; }

 private:
  void latch(const std::string& key, const Sample& sample) {
    for (auto& [known, last] : topic_->latched) {
      if (known == key) {
        last = sample;
        return;
      }
    }
    topic_->latched.emplace_back(key, sample);
  }

  std::shared_ptr<Bus> bus_;
  std::shared_ptr<Topic> topic_;
  Qos qos_;
  std::string id_;
  std::uint64_t sequence_ = 0;
};

InProcessTransport::InProcessTransport(bool complete) : bus_(std::make_shared<Bus>()) {
  bus_->complete = complete;
}
InProcessTransport::~InProcessTransport() = default;

std::shared_ptr<InProcessTransport::Topic> InProcessTransport::topic(const std::string& name,
                                                                     const MessageType& type) {
  const std::scoped_lock lock(bus_->mutex);
  auto& entry = bus_->topics[name];
  if (!entry) {
    entry = std::make_shared<Topic>();
    entry->name = name;
    entry->type = &type;
  }
  if (entry->type != &type) {
    throw std::runtime_error("topic " + name + " carries " + entry->type->name() + ", not " +
                             type.name());
  }
  return entry;
}

std::unique_ptr<Writer> InProcessTransport::create_writer(const std::string& name,
                                                          const MessageType& type, Qos qos) {
  return std::make_unique<BusWriter>(bus_, topic(name, type), qos);
}

std::unique_ptr<Reader> InProcessTransport::create_reader(const std::string& name,
                                                          const MessageType& type, Qos qos,
                                                          std::function<void()> on_data) {
  return std::make_unique<BusReader>(bus_, topic(name, type), qos, std::move(on_data));
}

std::shared_ptr<void> InProcessTransport::on_match(std::function<void()> callback) {
  auto kept = std::make_shared<std::function<void()>>(std::move(callback));
  const std::scoped_lock lock(bus_->mutex);
  bus_->match_callbacks.push_back(kept);
  return kept;
}

}  // namespace coop::runtime
