#include "arm_driver/pick_record.hpp"

#include <array>
#include <nlohmann/json.hpp>

namespace coop::arm_driver {
namespace {

constexpr std::string_view kFormat = "coop pick record 1";
constexpr std::array<std::string_view, 6> kOutcomes{"PICKED",      "OUT_OF_REACH", "NO_VACUUM",
                                                    "JOINT_LIMIT", "ABORTED",      "BUSY"};
constexpr std::array<std::string_view, 3> kStages{"started", "holding", "releasing"};

/// The enumerator of that name; throws what the parser throws where there is none.
template <class Enum, std::size_t kCount>
Enum parse_enum(const nlohmann::json& json, const std::array<std::string_view, kCount>& names) {
  const auto text = json.get<std::string>();
  for (std::size_t i = 0; i < kCount; ++i) {
    if (text == names[i]) return static_cast<Enum>(i);
  }
  throw nlohmann::json::other_error::create(599, "unknown value '" + text + "'", &json);
}

}  // namespace

std::string_view to_string(PickOutcome outcome) {
  return kOutcomes.at(static_cast<std::size_t>(outcome));
}

const PickReport* PickRecord::find(std::string_view pick_id) const {
  for (const PickReport& report : results) {
    if (report.pick_id == pick_id) return &report;
  }
  return nullptr;
}

void PickRecord::add(PickReport report) {
  results.push_back(std::move(report));
  if (results.size() > kMaxResults) results.pop_front();
}

std::string to_text(const PickRecord& record) {
  nlohmann::ordered_json json;
  json["format"] = kFormat;
  json["running"] = nullptr;
  if (record.running) {
    json["running"] = {{"pick_id", record.running->pick_id},
                       {"egg_id", record.running->egg_id},
                       {"stage", kStages.at(static_cast<std::size_t>(record.running->stage))}};
  }
  json["results"] = nlohmann::ordered_json::array();
  for (const PickReport& report : record.results) {
    json["results"].push_back({{"pick_id", report.pick_id},
                               {"egg_id", report.egg_id},
                               {"outcome", to_string(report.outcome)},
                               {"detail", report.detail}});
  }
  // Names come from messages: bytes that are no UTF-8 must not stop the driver.
  return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

Result<PickRecord> parse_pick_record(std::string_view text) {
  PickRecord record;
  try {
    const auto json = nlohmann::json::parse(text);
    if (json.at("format") != kFormat) return fail("is of another format");
    if (const auto& running = json.at("running"); !running.is_null()) {
      record.running = RunningPick{running.at("pick_id").get<std::string>(),
                                   running.at("egg_id").get<std::string>(),
                                   parse_enum<PickStage>(running.at("stage"), kStages)};
    }
    for (const auto& result : json.at("results")) {
      record.add({result.at("pick_id").get<std::string>(), result.at("egg_id").get<std::string>(),
                  parse_enum<PickOutcome>(result.at("outcome"), kOutcomes),
                  result.at("detail").get<std::string>()});
    }
  } catch (const nlohmann::json::exception& error) {
    return fail(std::string("is no record of picks: ") + error.what());
  }
  return record;
}

}  // namespace coop::arm_driver
