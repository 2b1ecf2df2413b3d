#include "runtime/lockstep/sample_trace.hpp"

#include <fmt/format.h>

// Header-only: nothing more to link or to install on the robot.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace coop::runtime {
namespace {

constexpr std::size_t kBuffer = 64U << 10U;
constexpr std::string_view kFolder = "trace";
constexpr std::string_view kSuffix = ".trace";

struct Entry {
  std::uint64_t tick = 0;
  std::string component;
  std::string topic;
  std::uint64_t sequence = 0;
  std::uint64_t hash = 0;

  [[nodiscard]] auto place() const { return std::tie(tick, component, topic, sequence); }
  [[nodiscard]] std::string text() const {
    return fmt::format("tick {}, {} of {}, sample {}", tick, topic, component, sequence);
  }
};

void read_file(const std::filesystem::path& path, std::uint64_t last_tick,
               std::vector<Entry>& entries) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": cannot be read");
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    if (in.eof()) break;  // the last line of a killed program may be cut short
    Entry entry;
    entry.component = path.stem().string();
    std::istringstream fields(line);
    if (!(fields >> entry.tick >> entry.topic >> entry.sequence >> std::hex >> entry.hash)) {
      throw std::runtime_error(
          fmt::format("{}:{}: expected: tick topic sequence hash", path.string(), number));
    }
    if (entry.tick <= last_tick) entries.push_back(std::move(entry));
  }
}

std::vector<Entry> read_traces(const std::filesystem::path& run_dir, std::uint64_t last_tick) {
  std::vector<Entry> entries;
  const auto folder = run_dir / kFolder;
  if (!std::filesystem::is_directory(folder)) {
    throw std::runtime_error(run_dir.string() + ": no traces of a lockstep run in it");
  }
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() == kSuffix) read_file(file.path(), last_tick, entries);
  }
  std::ranges::stable_sort(entries, {}, &Entry::place);
  return entries;
}

std::uint64_t mix(std::uint64_t hash, const Entry& entry) {
  const std::string text = fmt::format("{} {} {} {} {:016x}", entry.tick, entry.component,
                                       entry.topic, entry.sequence, entry.hash);
  return XXH3_64bits_withSeed(text.data(), text.size(), hash);
}

}  // namespace

SampleTrace::SampleTrace(const std::filesystem::path& run_dir, const std::string& component) {
  const auto folder = run_dir / kFolder;
  std::filesystem::create_directories(folder);
  const auto path = folder / (component + std::string(kSuffix));
  file_.open(path, std::ios::app);
  if (!file_) throw std::runtime_error(path.string() + ": cannot be written");
}

SampleTrace::~SampleTrace() {
  flush();
}

void SampleTrace::flush() {
  file_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  file_.flush();
  buffer_.clear();
}

void SampleTrace::record(std::string_view topic, std::uint64_t sequence, const MessageType& type,
                         const void* message) {
  type.serialize(message, bytes_);
  fmt::format_to(std::back_inserter(buffer_), "{} {} {} {:016x}\n", tick_, topic, sequence,
                 XXH3_64bits(bytes_.data(), bytes_.size()));
  if (buffer_.size() > kBuffer) flush();
}

TraceSummary summarise_traces(const std::filesystem::path& run_dir, std::uint64_t last_tick) {
  TraceSummary summary;
  for (const Entry& entry : read_traces(run_dir, last_tick)) {
    auto& topic = summary.topics[entry.component + " " + entry.topic];
    topic.samples += 1;
    topic.hash = mix(topic.hash, entry);
    summary.samples += 1;
    summary.hash = mix(summary.hash, entry);
    summary.last_tick = entry.tick;
  }
  return summary;
}

std::optional<std::string> first_difference(const std::filesystem::path& run_dir,
                                            const std::filesystem::path& other_run_dir,
                                            std::uint64_t last_tick) {
  const std::vector<Entry> ours = read_traces(run_dir, last_tick);
  const std::vector<Entry> theirs = read_traces(other_run_dir, last_tick);
  for (std::size_t i = 0; i < std::min(ours.size(), theirs.size()); ++i) {
    if (ours[i].place() != theirs[i].place()) {
      const bool is_ours = ours[i].place() < theirs[i].place();
      return fmt::format("{}: only in {}", (is_ours ? ours[i] : theirs[i]).text(),
                         (is_ours ? run_dir : other_run_dir).string());
    }
    if (ours[i].hash != theirs[i].hash) {
      return fmt::format("{}: {:016x} and {:016x}", ours[i].text(), ours[i].hash, theirs[i].hash);
    }
  }
  if (ours.size() == theirs.size()) return std::nullopt;
  const bool is_ours = ours.size() > theirs.size();
  const Entry& extra = is_ours ? ours[theirs.size()] : theirs[ours.size()];
  return fmt::format("{}: only in {}", extra.text(), (is_ours ? run_dir : other_run_dir).string());
}

}  // namespace coop::runtime
