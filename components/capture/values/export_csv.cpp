#include "capture/values/export_csv.hpp"

#include "capture/values/layouts.hpp"
#include "capture/values/output.hpp"
#include "core/csv.hpp"

namespace coop::capture {
namespace {

[[noreturn]] void refuse(const std::string& topic, const mcap::Message& message,
                         const CdrError& error) {
  throw std::runtime_error(topic + ": the message logged at " + seconds_text(message.log_time) +
                           " s is malformed: " + error.text());
}

/// The one layout of all channels of a topic.
const MessageLayout& layout_of_topic(const mcap::Summary& summary, const std::string& topic,
                                     Layouts& layouts) {
  const MessageLayout* result = nullptr;
  for (const auto& [id, channel] : summary.channels) {
    if (channel.topic != topic) continue;
    const MessageLayout* layout = layouts.of(channel, summary.schema_of(channel));
    if (layout == nullptr) throw std::runtime_error(topic + ": " + layouts.why(channel));
    if (result != nullptr && !(*result == *layout)) {
      throw std::runtime_error(topic + ": channels of different types, " + result->name() +
                               " and " + layout->name());
    }
    result = layout;
  }
  if (result == nullptr) throw std::runtime_error("no topic " + topic + " in the file");
  return *result;
}

}  // namespace

CsvReport export_csv(mcap::Reader& reader, const std::string& name, const CsvOptions& options,
                     std::ostream& out) {
  const std::string topic = topic_in_file(reader.summary(), name);
  Layouts layouts;
  CsvColumns columns(layout_of_topic(reader.summary(), topic, layouts), options);
  const mcap::Selection selection{.topics = {topic}};
  auto first_pass = reader.messages(selection);
  while (const auto read = first_pass.next()) {
    const auto measured = columns.measure(read->message.data);
    if (!measured) refuse(topic, read->message, measured.error());
  }
  columns.settle();

  std::vector<std::string> line{"log_time"};
  const auto names = columns.names();
  line.insert(line.end(), names.begin(), names.end());
  put(out, csv_line(line));
  CsvReport report{.columns = line.size()};
  auto second_pass = reader.messages(selection);
  while (const auto read = second_pass.next()) {
    const auto row = columns.row(read->message.data);
    if (!row) refuse(topic, read->message, row.error());
    line.resize(1);
    line.front() = seconds_text(read->message.log_time);
    line.insert(line.end(), (*row)->begin(), (*row)->end());
    put(out, csv_line(line));
    ++report.rows;
  }
  out.flush();
  return report;
}

}  // namespace coop::capture
