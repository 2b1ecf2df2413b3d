#include <algorithm>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <system_error>

#include "capture/mcap/chunk_target.hpp"

namespace coop::mcap {
namespace {

class FileSeries final : public ChunkTarget {
 public:
  FileSeries(Series series, FileOptions options, const Definitions& definitions)
      : series_(std::move(series)), options_(std::move(options)), definitions_(definitions) {
    open();
  }

  void add(const ReadyChunk& chunk) override {
    if (is_full_for(chunk)) next_file();
    const bool has_messages = !chunk.channels.empty();
    if (has_messages && !file_begin_) file_begin_ = chunk.chunk.message_start_time;
    guarded([&] {
      const Definitions::View fresh = definitions_.after(schemas_, channels_);
      file_->add(chunk, fresh.schemas, fresh.channels);
      schemas_ += fresh.schemas.size();
      channels_ += fresh.channels.size();
      if (options_.sync == Sync::kEachChunk) file_->sync();
    });
  }

  void add(std::shared_ptr<const StoredAttachment> attachment, Where where) override {
    guarded([&] { file_->add(attachment->attachment); });
    if (where == Where::kEveryFile) attachments_.push_back(std::move(attachment));
  }

  void add(const Metadata& metadata, Where where) override {
    guarded([&] { file_->add(metadata); });
    if (where == Where::kEveryFile) metadata_.push_back(metadata);
  }

  std::uint64_t write_snapshot(const std::filesystem::path&) override {
    throw std::logic_error("a capture into files has nothing in memory to write out");
  }

  void begin_anew(const std::filesystem::path& path) override {
    series_.path = path;
    parts_ = 0;
    next_file();
  }

  void finish() override {
    if (failure_) return;
    guarded([&] { close(); });
  }

  [[nodiscard]] std::uint64_t bytes() const override {
    return finished_bytes_ + (file_ ? file_->size() : 0);
  }

 private:
  [[nodiscard]] bool splits() const {
    return series_.split_bytes > 0 || series_.split_duration > 0;
  }

  /// A file has at least one chunk.
  [[nodiscard]] bool is_full_for(const ReadyChunk& chunk) const {
    if (failure_ || file_->statistics().chunk_count == 0) return false;
    const bool too_large =
        series_.split_bytes > 0 && file_->size() + chunk.chunk.records.size() > series_.split_bytes;
    const bool too_long = series_.split_duration > 0 && file_begin_ &&
                          chunk.chunk.message_end_time > *file_begin_ + series_.split_duration;
    return too_large || too_long;
  }

  [[nodiscard]] std::filesystem::path next_path() const {
    if (!splits()) return series_.path;
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "_%04zu", parts_ + 1);
    std::filesystem::path path = series_.path;
    return path.replace_filename(series_.path.stem().string() + number.data() +
                                 series_.path.extension().string());
  }

  void open() {
    const std::filesystem::path path = next_path();
    auto sink = create_file(path, options_.reserve);
    files_.push_back(path);
    ++parts_;
    file_ = std::make_unique<FileWriter>(std::move(sink), options_.header, options_.layout);
    schemas_ = channels_ = 0;
    file_begin_.reset();
    for (const auto& attachment : attachments_) file_->add(attachment->attachment);
    for (const Metadata& metadata : metadata_) file_->add(metadata);
  }

  void next_file() {
    guarded([&] {
      close();
      finished_bytes_ += file_->size();
      file_.reset();
      open();
    });
  }

  void close() {
    add_definitions();
    file_->finish();
    if (options_.sync != Sync::kNever) file_->sync();
  }

  void add_definitions() {
    const Definitions::View fresh = definitions_.after(schemas_, channels_);
    for (const Schema* schema : fresh.schemas) file_->add(*schema);
    for (const Channel* channel : fresh.channels) file_->add(*channel);
  }

  /// After the first failure the file is closed as well as it goes (its records are whole; the
  /// summary may fit where the chunk did not), and nothing more is taken.
  template <class Function>
  void guarded(const Function& function) {
    if (failure_) throw std::system_error(*failure_);
    try {
      function();
    } catch (const std::system_error& error) {
      failure_ = error;
      try {
        if (file_) file_->finish();
      } catch (const std::system_error&) {
        // The file stays without an end: readers scan it, recovery completes it.
      }
      throw;
    }
  }

  Series series_;
  FileOptions options_;
  const Definitions& definitions_;
  std::unique_ptr<FileWriter> file_;
  std::size_t parts_ = 0;    // of the series
  std::size_t schemas_ = 0;  // of the definitions, in this file
  std::size_t channels_ = 0;
  std::optional<Nanoseconds> file_begin_;
  std::uint64_t finished_bytes_ = 0;
  std::vector<std::shared_ptr<const StoredAttachment>> attachments_;
  std::vector<Metadata> metadata_;
  std::optional<std::system_error> failure_;
};

}  // namespace

std::unique_ptr<ChunkTarget> make_series(const Series& series, const FileOptions& options,
                                         const Definitions& definitions) {
  return std::make_unique<FileSeries>(series, options, definitions);
}

}  // namespace coop::mcap
