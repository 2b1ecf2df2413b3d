#pragma once
#include <memory>
#include <string>

#include "runtime/dds_settings.hpp"
#include "runtime/transport.hpp"

namespace coop::runtime {

struct DdsOptions {
  int domain = 0;
  std::string participant_name;
  /// Robots that share a domain are told apart by a partition of this name; empty: the default
  /// partition, as ROS 2 uses.
  std::string partition;
  /// Sensor streams reliable and complete, for replaying logs.
  bool reliable_streams = false;
  /// No sample of any topic is replaced by a newer one before its readers have it: for lockstep.
  bool complete = false;
  /// How others are found and reached, and whether strangers are kept out.
  DdsSettings settings = {};
  /// With a discovery server: it tells of all topics, not only of those one has endpoints for.
  bool sees_all_topics = false;
};

/// Fast DDS behind the Transport interface: UDPv4 with 4 MiB buffers unless the settings say
/// otherwise, data-sharing off, participant lease 5 s. Topic `scan` is `rt/scan` on the wire (ROS
/// 2's rule).
class DdsTransport : public Transport {
 public:
  /// Throws std::runtime_error when no participant can be made.
  explicit DdsTransport(const DdsOptions& options);
  ~DdsTransport() override;
  std::unique_ptr<Writer> create_writer(const std::string& topic, const MessageType& type,
                                        Qos qos) override;
  std::unique_ptr<Reader> create_reader(const std::string& topic, const MessageType& type, Qos qos,
                                        std::function<void()> on_data) override;
  [[nodiscard]] std::shared_ptr<void> on_match(std::function<void()> callback) override;
  /// Joins the domain anew where others have forgotten this program: it stood still for longer than
  /// its lease, or a discovery server is back that has given it up (docs/hosts.md). Its half of old
  /// connections remains, and never fits again (Fast DDS 2.9.1). Latched topics are told again.
  /// Never in lockstep (DdsOptions::complete).
  std::optional<std::string> mend() override;
  /// The next mend() joins anew, as after a pause that was not noticed.
  void note_pause(Duration pause);

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

}  // namespace coop::runtime
