#include "capture/values/print_messages.hpp"

#include "capture/schema/number_text.hpp"
#include "capture/values/layouts.hpp"
#include "capture/values/output.hpp"

namespace coop::capture {
namespace {

class Printer {
 public:
  explicit Printer(const PrintOptions& options) : format_(options.format), text_(options.text) {
    text_.indent = 1;
  }

  /// The whole entry of a message, valid until the next call.
  const std::string& print(const mcap::ReadMessage& read) {
    out_.clear();
    entry("topic", quoted(read.channel->topic));
    entry("sequence", std::to_string(read.message.sequence));
    entry("log_time", seconds_text(read.message.log_time));
    entry("publish_time", seconds_text(read.message.publish_time));
    std::string why = append_data(read);
    ++report_.messages;
    if (!why.empty()) {
      ++report_.undecoded;
      entry("data", "null");
      entry("error", quoted(why));
    }
    out_ += format_ == PrintFormat::kYaml ? "---\n" : "}\n";
    return out_;
  }

  [[nodiscard]] const PrintReport& report() const { return report_; }

 private:
  void entry(std::string_view name, std::string_view value) {
    if (format_ == PrintFormat::kYaml) {
      out_.append(name).append(": ").append(value).append("\n");
    } else {
      out_ += out_.empty() ? '{' : ',';
      out_.append("\"").append(name).append("\":").append(value);
    }
  }

  [[nodiscard]] std::string quoted(std::string_view text) const {
    std::string out;
    format_ == PrintFormat::kYaml ? append_yaml_string(out, text) : append_json_string(out, text);
    return out;
  }

  /// Empty, or why there are no values.
  std::string append_data(const mcap::ReadMessage& read) {
    const MessageLayout* layout = layouts_.of(*read.channel, read.schema);
    const auto size = " (" + std::to_string(read.message.data.size()) + " bytes)";
    if (layout == nullptr) return layouts_.why(*read.channel) + size;
    const std::size_t before = out_.size();
    out_ += format_ == PrintFormat::kYaml ? "data:\n" : ",\"data\":";
    const auto written = format_ == PrintFormat::kYaml
                             ? append_yaml(*layout, read.message.data, text_, out_)
                             : append_json(*layout, read.message.data, text_, out_);
    if (written) return {};
    out_.resize(before);
    return written.error().text() + size;
  }

  PrintFormat format_;
  TextOptions text_;
  Layouts layouts_;
  PrintReport report_;
  std::string out_;
};

}  // namespace

PrintReport print_messages(mcap::Reader& reader, const PrintOptions& options, std::ostream& out) {
  mcap::Selection selection = options.selection;
  for (std::string& topic : selection.topics) topic = topic_in_file(reader.summary(), topic);
  Printer printer(options);
  auto messages = reader.messages(selection);
  while (const auto read = messages.next()) put(out, printer.print(*read));
  out.flush();
  return printer.report();
}

}  // namespace coop::capture
