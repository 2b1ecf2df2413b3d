#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/time.hpp"
#include "runtime/message_type.hpp"
#include "runtime/qos.hpp"

namespace coop::runtime {

/// One received message. Writer and sequence number identify it among all of its topic: a scheduler
/// that must handle inputs in a fixed order sorts by (topic, writer, sequence).
struct Sample {
  std::shared_ptr<const void> message;
  std::string writer;          ///< unique identity of the writer
  std::uint64_t sequence = 0;  ///< of that writer, from 1
};

class Writer {
 public:
  virtual ~Writer() = default;
  /// Unique in the system; the `writer` of its samples.
  [[nodiscard]] virtual const std::string& id() const = 0;
  /// False when the message could not be handed over in time (history of a reliable topic full,
  /// reader too slow).
  virtual bool write(const void* message) = 0;
  /// Sequence number of the last message written, 0 before the first.
  [[nodiscard]] virtual std::uint64_t sequence() const = 0;
  [[nodiscard]] virtual int matched_readers() const = 0;
  /// Whether samples written from now on reach the reader of this id.
  [[nodiscard]] virtual bool reaches(const std::string& reader_id) const = 0;
  /// Waits (wall time) until every reliable reader has acknowledged everything. False on time-out.
  virtual bool wait_for_acknowledgments(Duration timeout) = 0;
};

class Reader {
 public:
  virtual ~Reader() = default;
  /// Unique in the system.
  [[nodiscard]] virtual const std::string& id() const = 0;
  /// The next message in order of arrival; false when there is none.
  virtual bool take(Sample& sample) = 0;
  [[nodiscard]] virtual int matched_writers() const = 0;
  /// Its samples may wait until the component has something else to do. Says nothing to transports
  /// that deliver at once.
  virtual void be_patient() {}
  /// Whether it listens to the writer of this id.
  [[nodiscard]] virtual bool hears(const std::string& writer_id) const = 0;
};

/// Carries messages between nodes. Topic names are the project's own ("scan"); what they are on the
/// wire is the transport's matter. Errors (a name already in use with another type) are
/// std::runtime_error.
class Transport {
 public:
  virtual ~Transport() = default;
  virtual std::unique_ptr<Writer> create_writer(const std::string& topic, const MessageType& type,
                                                Qos qos) = 0;
  /// `on_data` is called from any thread when there may be something to take.
  virtual std::unique_ptr<Reader> create_reader(const std::string& topic, const MessageType& type,
                                                Qos qos, std::function<void()> on_data) = 0;
  /// Called from any thread when an endpoint found or lost a counterpart, for as long as the caller
  /// keeps what is returned. Set it before the first endpoint is made.
  [[nodiscard]] virtual std::shared_ptr<void> on_match(std::function<void()> callback) = 0;
  /// For the thread that uses the endpoints to call now and then: mends what only it can. When all
  /// endpoints were made anew (their ids are new, too): why, for people.
  virtual std::optional<std::string> mend() { return std::nullopt; }
};

}  // namespace coop::runtime
