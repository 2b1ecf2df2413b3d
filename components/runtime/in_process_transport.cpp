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
  int writers = 0;
  /// Last sample a (writer, key) of latched writers, in order of first appearance.
  std::vector<std::pair<std::string, Sample>> latched;
};

struct InProcessTransport::Bus {
  std::mutex mutex;
  std::map<std::string, std::shared_ptr<Topic>> topics;
  int writers_ever = 0;
};

class InProcessTransport::BusReader : public Reader {
 public:
  BusReader(std::shared_ptr<Bus> bus, std::shared_ptr<Topic> topic, Qos qos,
            std::function<void()> on_data)
      : bus_(std::move(bus)), topic_(std::move(topic)), qos_(qos), on_data_(std::move(on_data)) {
    const std::scoped_lock lock(bus_->mutex);
    topic_->readers.push_back(this);
    if (is_latched(qos_)) {
      for (const auto& [key, sample] : topic_->latched) queue_.push_back(sample);
    }
    if (!queue_.empty()) on_data_();
  }
  ~BusReader() override {
    const std::scoped_lock lock(bus_->mutex);
    std::erase(topic_->readers, this);
  }
  bool take(Sample& sample) override {
    const std::scoped_lock lock(bus_->mutex);
    if (queue_.empty()) return false;
    sample = std::move(queue_.front());
    queue_.pop_front();
    return true;
  }
  int matched_writers() const override {
    const std::scoped_lock lock(bus_->mutex);
    return topic_->writers;
  }
  /// With the bus locked.
  void deliver(const Sample& sample) {
    queue_.push_back(sample);
    const std::size_t depth = qos_ == Qos::kSensorStream ? 5U : qos_ == Qos::kCommand ? 1U : 2000U;
    while (queue_.size() > depth) queue_.pop_front();
    on_data_();
  }
  static bool is_latched(Qos qos) { return qos == Qos::kStateLatched || qos == Qos::kHeartbeat; }

 private:
  std::shared_ptr<Bus> bus_;
  std::shared_ptr<Topic> topic_;
  Qos qos_;
  std::function<void()> on_data_;
  std::deque<Sample> queue_;
};

class InProcessTransport::BusWriter : public Writer {
 public:
  BusWriter(std::shared_ptr<Bus> bus, std::shared_ptr<Topic> topic, Qos qos)
      : bus_(std::move(bus)), topic_(std::move(topic)), qos_(qos) {
    const std::scoped_lock lock(bus_->mutex);
    topic_->writers += 1;
    name_ = "writer" + std::to_string(++bus_->writers_ever);
  }
  ~BusWriter() override {
    const std::scoped_lock lock(bus_->mutex);
    topic_->writers -= 1;
    std::erase_if(topic_->latched,
                  [this](const auto& entry) { return entry.second.writer == name_; });
  }
  bool write(const void* message) override {
    const Sample sample{topic_->type->clone(message), name_, ++sequence_};
    const std::scoped_lock lock(bus_->mutex);
    if (BusReader::is_latched(qos_)) latch(name_ + topic_->type->key_of(message), sample);
    for (BusReader* reader : topic_->readers) reader->deliver(sample);
    return true;
  }
  std::uint64_t sequence() const override { return sequence_; }
  int matched_readers() const override {
    const std::scoped_lock lock(bus_->mutex);
    return static_cast<int>(topic_->readers.size());
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
  std::string name_;
  std::uint64_t sequence_ = 0;
};

InProcessTransport::InProcessTransport() : bus_(std::make_shared<Bus>()) {}
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

}  // namespace coop::runtime
