#pragma once
#include <map>
#include <memory>
#include <mutex>

#include "runtime/transport.hpp"

namespace coop::runtime {

/// Joins the nodes of one process without DDS, for component tests: same intents (latched topics
/// reach late readers, keyed ones a sample a key; streams keep the last 5), no serialisation,
/// delivery within write(). Thread-safe.
class InProcessTransport : public Transport {
 public:
  /// `complete`: streams and commands keep every sample, as in lockstep.
  explicit InProcessTransport(bool complete = false);
  ~InProcessTransport() override;
  std::unique_ptr<Writer> create_writer(const std::string& topic, const MessageType& type,
                                        Qos qos) override;
  std::unique_ptr<Reader> create_reader(const std::string& topic, const MessageType& type, Qos qos,
                                        std::function<void()> on_data) override;
  [[nodiscard]] std::shared_ptr<void> on_match(std::function<void()> callback) override;

 private:
  struct Topic;
  struct Bus;
  class BusWriter;
  class BusReader;
  std::shared_ptr<Topic> topic(const std::string& name, const MessageType& type);

  std::shared_ptr<Bus> bus_;
};

}  // namespace coop::runtime
