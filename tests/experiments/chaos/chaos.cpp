#include "experiments/chaos/chaos.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <ostream>

#include "core/csv.hpp"
#include "experiments/chaos/mission_run.hpp"

namespace coop::chaos {
namespace {

constexpr int kDiskSize = 96;  // MB: runs' folders of one mission, and something to fill
constexpr int kMostMissions = 100;

std::string shown(std::optional<double> value) {
  return value ? fmt::format("{:.2f}", *value) : "";
}

/// "median / greatest", or a dash.
std::string spread(std::vector<double> values) {
  if (values.empty()) return "-";
  std::ranges::sort(values);
  return fmt::format("{:.2f} / {:.2f}", values[values.size() / 2], values.back());
}

template <class Select>
std::string row_of(const std::string& name, const std::vector<Incident>& all, Select select) {
  int count = 0;
  int wrong = 0;
  std::vector<double> noticed, recovered, braking;
  for (const Incident& incident : all) {
    if (!select(incident)) continue;
    ++count;
    if (!incident.wrong.empty()) ++wrong;
    if (incident.noticed) noticed.push_back(*incident.noticed);
    if (incident.recovered) recovered.push_back(*incident.recovered);
    if (incident.braking) braking.push_back(*incident.braking);
  }
  if (count == 0) return "";
  return fmt::format("| {} | {} | {} of {} | {} | {} | {} of {} | {} |\n", name, count,
                     spread(noticed), noticed.size(), spread(recovered), spread(braking),
                     braking.size(), count, wrong);
}

}  // namespace

ChaosResult run_chaos(const ChaosOptions& options, std::ostream& log) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / fmt::format("coop-chaos-{}", getpid());
  std::filesystem::create_directories(folder);
  const Ground ground(folder, kDiskSize);
  fmt::print(log, "chaos: seed {}, {} faults{}{}\n", options.seed, options.faults,
             ground.abilities().network ? "" : "; no network faults: needs root and iptables",
             ground.abilities().disk ? "" : "; no full disk: needs root");
  FaultPlan plan(options.seed, options.components, ground.abilities(), options.gap);
  ChaosResult result;
  int left = options.faults;
  for (int number = 1; left > 0 && number <= kMostMissions; ++number) {
    MissionRun mission(options, ground, number, log);
    mission.run(plan, left);
    for (Incident incident : mission.incidents()) {
      incident.number = static_cast<int>(result.incidents.size()) + 1;
      result.incidents.push_back(std::move(incident));
    }
    result.wrong.insert(result.wrong.end(), mission.wrong().begin(), mission.wrong().end());
    result.missions.push_back(mission.summary());
    result.simulated += mission.simulated();
    fmt::print(log, "{}\n", mission.summary());
  }
  return result;
}

std::string report_of(const ChaosOptions& options, const ChaosResult& result) {
  std::string text = fmt::format(
      "# Chaos\nSeed {}, {} faults in {} missions, {:.0f} s of simulated time at rate {}.\n\n",
      options.seed, result.incidents.size(), result.missions.size(), result.simulated,
      options.rate);
  const std::string heading =
      " | n | noticed after, s: median / max | recovered after, s: median / max | "
      "braking begun after, s: median / max | promises broken |\n|---|---|---|---|---|---|\n";
  text += "| fault" + heading;
  for (int kind = 0; kind < kFaultKinds; ++kind) {
    const auto wanted = static_cast<FaultKind>(kind);
    text += row_of(std::string(name_of(wanted)), result.incidents,
                   [&](const Incident& incident) { return incident.fault.kind == wanted; });
  }
  text += row_of("all", result.incidents, [](const Incident&) { return true; });
  text += "\n| component" + heading;
  std::vector<std::string> names;
  for (const Incident& incident : result.incidents) names.push_back(incident.fault.component);
  std::ranges::sort(names);
  names.erase(std::ranges::unique(names).begin(), names.end());
  for (const std::string& name : names) {
    text += row_of(name.empty() ? "all at once" : name, result.incidents,
                   [&](const Incident& incident) { return incident.fault.component == name; });
  }
  text += "\n";
  for (const std::string& mission : result.missions) text += "- " + mission + "\n";
  text += result.wrong.empty() ? "\nAll promises were kept.\n" : "\nBroken promises:\n";
  for (const std::string& wrong : result.wrong) text += "- " + wrong + "\n";
  return text;
}

std::string csv_of(const ChaosResult& result) {
  std::string text = csv_line({"fault", "mission", "simulated_s", "kind", "component", "duration_s",
                               "amount", "noticed_s", "recovered_s", "braking_s", "seen", "wrong"});
  for (const Incident& incident : result.incidents) {
    const Fault& fault = incident.fault;
    text += csv_line({std::to_string(incident.number), std::to_string(incident.mission),
                      fmt::format("{:.2f}", incident.simulated), std::string(name_of(fault.kind)),
                      fault.component, fmt::format("{:.2f}", fault.duration),
                      fmt::format("{:.2f}", fault.amount), shown(incident.noticed),
                      shown(incident.recovered), shown(incident.braking), incident.seen,
                      incident.wrong});
  }
  return text;
}

}  // namespace coop::chaos
