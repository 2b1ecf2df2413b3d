#include "capture/node/capture_saver.hpp"

#include <ctime>

#include "capture/traffic/kept_files.hpp"
#include "conversions/time.hpp"
#include "coop_msgs/msg/ComponentStatus.h"
#include "coop_msgs/msg/EmergencyStop.h"
#include "coop_msgs/msg/SaveCapture.h"
#include "runtime/raw_message.hpp"

namespace coop::capture {

using Bytes = std::vector<std::uint8_t>;
using Wall = std::chrono::steady_clock;

namespace {

/// In the names of captures that nobody asked for.
constexpr const char* kOfFault = "-fault";
/// Bytes of a capture besides the ring's chunks: attachments, indexes.
constexpr std::uint64_t kRoomToSpare = 1U << 20U;

}  // namespace

std::string date_and_time() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  std::strftime(text, sizeof text, "%Y%m%d-%H%M%S", &local);
  return text;
}

CaptureSaver::CaptureSaver(runtime::Node& node, Recording& recording, const RecordConfig& config,
                           std::function<std::filesystem::path(const std::string& kind)> new_path)
    : node_(node),
      recording_(recording),
      config_(config),
      new_path_(std::move(new_path)),
      results_(node.advertise<coop_msgs::msg::SaveCaptureResult>("save_capture_result",
                                                                 runtime::Qos::kEvent)) {}

void CaptureSaver::heartbeat(const Bytes& bytes) {
  coop_msgs::msg::ComponentStatus status;
  if (!runtime::from_wire(bytes, status) || status.name() == node_.name()) return;
  // The states of the message are counted as those of the watch.
  const auto state = static_cast<FaultWatch::State>(status.state());
  const auto fault = faults_.heartbeat(status.name(), state, status.detail());
  if (config_.save_on_fault && !system_stops_) plan(fault);
}

void CaptureSaver::component_gone(const std::string& component) {
  const auto fault = faults_.gone(component);
  if (config_.save_on_fault && !system_stops_) plan(fault);
}

void CaptureSaver::emergency_stop(const Bytes& bytes) {
  coop_msgs::msg::EmergencyStop stop;
  if (!runtime::from_wire(bytes, stop)) return;
  // The launcher engages it whenever it stops the system, and releases it at the next start. That
  // is no fault, nor is what becomes of the others then.
  if (stop.source() == "launcher") {
    system_stops_ = stop.engaged();
    return;
  }
  const auto fault = faults_.emergency_stop(stop.source(), stop.engaged(), stop.reason());
  if (config_.save_on_emergency_stop) plan(fault);
}

void CaptureSaver::order(const Bytes& bytes) {
  coop_msgs::msg::SaveCapture order;
  if (!runtime::from_wire(bytes, order)) return;
  const std::string reason = order.reason().empty() ? "asked for" : order.reason();
  if (recording_.is_ring()) {
    return begin(reason, order.request_id(), std::chrono::nanoseconds(0));
  }
  const auto files = recording_.status().files;
  answer({.request_id = order.request_id(), .path = files.empty() ? "" : files.back()}, true,
         "everything is recorded");
}

void CaptureSaver::plan(const std::optional<std::string>& fault) {
  if (fault && recording_.is_ring()) begin(*fault, "", seconds(config_.save_delay));
}

void CaptureSaver::begin(const std::string& reason, const std::string& request_id,
                         std::chrono::nanoseconds delay) {
  if (save_ && request_id.empty()) return;  // what happens together is in one capture
  if (save_ && (save_->messages.valid() || !save_->request_id.empty())) {
    return answer({.request_id = request_id}, false, "is writing another one");
  }
  if (!save_) node_.log().info("the ring will be written: {}", reason);
  const std::string first_reason = save_ ? save_->reason : reason;
  save_ = Save{.due = Wall::now() + delay,
               .reason = first_reason,
               .request_id = request_id,
               .path = new_path_(request_id.empty() ? kOfFault : "-snapshot")};
}

void CaptureSaver::work() {
  if (!save_ || save_->due > Wall::now()) return;
  try {
    if (!save_->messages.valid()) {
      if (!make_room()) throw std::runtime_error("the disk is too full");
      recording_.note("coop.saved", {{"reason", save_->reason}, {"at", date_and_time()}});
      save_->messages = recording_.save(save_->path);
      return;
    }
    if (save_->messages.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    answer(*save_, true, std::to_string(save_->messages.get()) + " messages: " + save_->reason);
  } catch (const std::exception& problem) {
    answer(*save_, false, problem.what());
  }
  save_.reset();
}

/// For the ring as it is now, at the cost of older captures that nobody asked for.
bool CaptureSaver::make_room() const {
  const std::uint64_t size = recording_.status().bytes + kRoomToSpare;
  const std::filesystem::path folder = save_->path.parent_path();
  return keep_newest(folder, node_.name() + "-", kOfFault, config_.limits_before(size));
}

void CaptureSaver::finish() {
  if (!save_) return;
  save_->due = {};
  if (!save_->messages.valid()) work();
  if (save_ && save_->messages.valid()) save_->messages.wait();
  work();
}

void CaptureSaver::answer(const Save& save, bool success, const std::string& detail) {
  node_.log().info("capture {}: {}", success ? save.path.string() : "not written", detail);
  coop_msgs::msg::SaveCaptureResult result;
  result.header(conversions::to_header(node_.now(), ""));
  result.request_id(save.request_id);
  result.success(success);
  result.detail(detail);
  if (success) result.path(std::filesystem::absolute(save.path).string());
  results_.publish(result);
}

}  // namespace coop::capture
