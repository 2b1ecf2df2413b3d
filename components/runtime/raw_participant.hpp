#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "runtime/dds_transport.hpp"
#include "runtime/raw_message.hpp"

namespace coop::runtime {

/// A writer or reader of somebody's, as discovery tells it.
struct DiscoveredEndpoint {
  EndpointId id;
  bool is_writer = false;
  WireTopic topic;
  WireQos qos;
  std::string participant;  ///< name of its program; a component's is the component's name
};

struct DiscoveryEvent {
  enum class Kind : std::uint8_t { kFound, kChanged, kLost };
  Kind kind = Kind::kFound;
  DiscoveredEndpoint endpoint;
};

class RawReader {
 public:
  virtual ~RawReader() = default;
  [[nodiscard]] virtual int matched_writers() const = 0;
  [[nodiscard]] virtual bool hears(const EndpointId& writer) const = 0;
};

class RawWriter {
 public:
  virtual ~RawWriter() = default;
  [[nodiscard]] virtual EndpointId id() const = 0;
  /// False when the sample could not be handed over in time, or is none.
  virtual bool write(const std::vector<std::uint8_t>& bytes) = 0;
  [[nodiscard]] virtual int matched_readers() const = 0;
  virtual bool wait_for_acknowledgments(Duration timeout) = 0;
};

/// Takes part in a domain without knowing its types: finds what topics there are, and who writes
/// and reads them, and carries their samples as bytes. A participant of its own, beside the one of
/// a component: a type is either known or raw within a participant.
///
/// Everything made here must be gone before it.
class RawParticipant {
 public:
  /// `on_news` is called from any thread when there are events to take or endpoints have found or
  /// lost counterparts.
  RawParticipant(const DdsOptions& options, const std::function<void()>& on_news);
  ~RawParticipant();
  RawParticipant(const RawParticipant&) = delete;
  RawParticipant& operator=(const RawParticipant&) = delete;

  /// What discovery has told since the last call, in order. Endpoints of this participant are not
  /// told of.
  [[nodiscard]] std::vector<DiscoveryEvent> take_events();

  /// For the thread that uses the endpoints to call now and then: joins the domain anew where
  /// others have forgotten this program (Transport::mend()). True when it did: all that was known
  /// is told as lost and found again. What a latched writer has written is not told again.
  bool mend();
  void join_anew();

  /// `on_sample` is called on the thread that received the sample, one at a time: it must be quick.
  /// The reader's own history keeps nothing, so that no writer ever waits for it.
  [[nodiscard]] std::unique_ptr<RawReader> create_reader(
      const WireTopic& topic, const WireQos& qos, std::function<void(RawSample&&)> on_sample);
  [[nodiscard]] std::unique_ptr<RawWriter> create_writer(const WireTopic& topic,
                                                         const WireQos& qos);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// What a reader must ask for to get everything that a writer with these policies offers.
[[nodiscard]] WireQos reader_for(const WireQos& offered);

}  // namespace coop::runtime
