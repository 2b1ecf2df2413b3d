#include "capture/mcap_tool/info.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>

namespace coop::mcap {
namespace {

constexpr Nanoseconds kSecond = 1'000'000'000;
/// The first second of 2000: what is before is no date but time since a start.
constexpr Nanoseconds kFirstDate = 946'684'800 * kSecond;

double to_seconds(Nanoseconds time) {
  return static_cast<double>(time) * 1e-9;
}

struct CompressionTotals {
  std::size_t chunks = 0;
  std::uint64_t compressed = 0;
  std::uint64_t uncompressed = 0;
};

std::string compression_lines(const Summary& summary) {
  std::map<std::string, CompressionTotals> totals;
  for (const ChunkIndex& chunk : summary.chunks) {
    CompressionTotals& total = totals[chunk.compression];
    ++total.chunks;
    total.compressed += chunk.compressed_size;
    total.uncompressed += chunk.uncompressed_size;
  }
  std::string out;
  for (const auto& [name, total] : totals) {
    const double ratio = total.uncompressed == 0 ? 1.0
                                                 : static_cast<double>(total.compressed) /
                                                       static_cast<double>(total.uncompressed);
    out += fmt::format("chunks       {} {}, {} of {} ({:.1f} %)\n", total.chunks,
                       name.empty() ? "uncompressed" : name, size_text(total.compressed),
                       size_text(total.uncompressed), 100.0 * ratio);
  }
  return out;
}

std::string channel_lines(const Summary& summary, double duration) {
  struct Row {
    std::string topic;
    std::string type;
    std::uint64_t count;
  };
  std::vector<Row> rows;
  std::size_t width = 5;
  for (const auto& [id, channel] : summary.channels) {
    const Schema* schema = summary.schema_of(channel);
    const auto& counts = summary.statistics ? summary.statistics->channel_message_counts
                                            : std::map<std::uint16_t, std::uint64_t>{};
    const auto count = counts.find(id);
    rows.push_back({channel.topic,
                    schema == nullptr ? channel.message_encoding + ", no schema"
                                      : schema->name + " (" + schema->encoding + ")",
                    count == counts.end() ? 0 : count->second});
    width = std::max(width, channel.topic.size());
  }
  std::ranges::stable_sort(rows, {}, &Row::topic);
  std::string out = fmt::format("{:<{}} {:>10} {:>10}  type\n", "topic", width, "messages", "Hz");
  for (const Row& row : rows) {
    const std::string rate =
        duration > 0 && row.count > 1
            ? fmt::format("{:.2f}", static_cast<double>(row.count - 1) / duration)
            : "-";
    out += fmt::format("{:<{}} {:>10} {:>10}  {}\n", row.topic, width, row.count, rate, row.type);
  }
  return out;
}

}  // namespace

std::string time_text(Nanoseconds time) {
  if (time < kFirstDate) return fmt::format("{}.{:09} s", time / kSecond, time % kSecond);
  const auto seconds = static_cast<std::time_t>(time / kSecond);
  return fmt::format("{:%Y-%m-%d %H:%M:%S}.{:09} UTC", fmt::gmtime(seconds), time % kSecond);
}

std::string size_text(std::uint64_t bytes) {
  constexpr std::array kUnits{"B", "kB", "MB", "GB", "TB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  while (value >= 999.95 && unit + 1 < kUnits.size()) {
    value /= 1000;
    ++unit;
  }
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", value, kUnits[unit]);
}

std::string info_text(const Reader& reader) {
  const Summary& summary = reader.summary();
  std::string out = fmt::format("file         {}, {}\n", reader.source().name(),
                                size_text(reader.source().size()));
  out += fmt::format("profile      {}\nlibrary      {}\n",
                     summary.header.profile.empty() ? "-" : summary.header.profile,
                     summary.header.library.empty() ? "-" : summary.header.library);
  double duration = 0;
  if (summary.statistics && summary.statistics->message_count > 0) {
    const Statistics& statistics = *summary.statistics;
    const Nanoseconds length =
        std::max(statistics.message_end_time, statistics.message_start_time) -
        statistics.message_start_time;
    duration = to_seconds(length);
    out += fmt::format("start        {}\nend          {}\nduration     {:.3f} s\n",
                       time_text(statistics.message_start_time),
                       time_text(statistics.message_end_time), duration);
  }
  out +=
      fmt::format("messages     {}\n", summary.statistics ? summary.statistics->message_count : 0);
  out += compression_lines(summary);
  if (!summary.complete) {
    out += fmt::format("INCOMPLETE   {}\n             `mcap recover` makes a complete file of it\n",
                       summary.defect);
  }
  out += "\n" + channel_lines(summary, duration);
  if (!summary.attachments.empty()) out += "\nattachments\n";
  for (const AttachmentIndex& attachment : summary.attachments) {
    out += fmt::format("  {:<30} {:>10}  {}\n", attachment.name, size_text(attachment.data_size),
                       attachment.media_type);
  }
  for (const MetadataIndex& metadata : summary.metadata) {
    out += "\nmetadata     " + metadata.name + "\n";
    for (const auto& [key, value] : reader.metadata(metadata).metadata) {
      out += fmt::format("  {} = {}\n", key, value);
    }
  }
  return out;
}

std::string listing_text(const ReadMessage& read) {
  const Message& message = read.message;
  return fmt::format("{}.{:09} {} seq {} {} B {}", message.log_time / kSecond,
                     message.log_time % kSecond, read.channel->topic, message.sequence,
                     message.data.size(), read.schema == nullptr ? "-" : read.schema->name);
}

std::string report_text(const RecoverReport& report) {
  std::string out;
  for (const std::string& note : report.notes) out += note + "\n";
  if (report.further_notes > 0) out += fmt::format("... and {} more\n", report.further_notes);
  out += fmt::format("{} messages in {} whole chunks", report.messages, report.chunks);
  if (report.salvaged_messages > 0) {
    out += fmt::format(" and {} messages beside them", report.salvaged_messages);
  }
  out += fmt::format(", {} attachments, {} metadata\n", report.attachments, report.metadata);
  if (report.lost_chunks > 0 || report.lost_attachments > 0 || report.skipped_bytes > 0) {
    out += fmt::format(
        "lost: {} chunks (in whole or in part), {} attachments, {} bytes of no record\n",
        report.lost_chunks, report.lost_attachments, report.skipped_bytes);
  }
  for (const auto& [id, count] : report.lost_messages) {
    const auto channel = report.channels.find(id);
    out += fmt::format(
        "  {} messages of {}\n", count,
        channel == report.channels.end() ? "channel " + std::to_string(id) : channel->second.topic);
  }
  return out;
}

}  // namespace coop::mcap
