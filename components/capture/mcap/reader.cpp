#include "capture/mcap/reader.hpp"

#include "capture/mcap/reader_state.hpp"

namespace coop::mcap {
namespace {

Summary summary_of(const std::shared_ptr<const Source>& source, const ReadLimits& limits) {
  std::string defect;
  try {
    std::optional<Summary> summary = read_summary(source, limits);
    if (summary) {
      const bool counted = summary->statistics.has_value();
      const bool empty = counted && summary->statistics->message_count == 0;
      if (empty || (counted && !summary->channels.empty())) return std::move(*summary);
    }
  } catch (const FileError& error) {
    defect = error.what();
  }
  Summary summary = scan(source, limits);
  if (!defect.empty()) {
    summary.complete = false;
    if (summary.defect.empty()) summary.defect = defect;
  }
  return summary;
}

}  // namespace

void ReaderState::scan_file() {
  if (summary.scanned) return;
  Summary found = scan(source, limits);
  // Nodes move without changing their addresses, and what is there stays.
  summary.schemas.merge(found.schemas);
  summary.channels.merge(found.channels);
  summary.chunks = std::move(found.chunks);
  summary.loose = std::move(found.loose);
  summary.complete = found.complete;
  summary.defect = std::move(found.defect);
  summary.scanned = true;
}

void ReaderState::need_index() {
  const bool empty = summary.statistics && summary.statistics->message_count == 0;
  if (summary.chunks.empty() && !empty) scan_file();
}

const Channel* ReaderState::channel(std::uint16_t id) {
  auto found = summary.channels.find(id);
  if (found == summary.channels.end()) {
    scan_file();
    found = summary.channels.find(id);
  }
  return found == summary.channels.end() ? nullptr : &found->second;
}

RawRecord ReaderState::read_record(Opcode opcode, std::uint64_t offset, std::uint64_t length,
                                   std::vector<std::byte>& bytes) const {
  const std::uint64_t size = source->size();
  if (length < kRecordPrefix || length > limits.max_record || offset > size ||
      length > size - offset) {
    throw FileError(offset, name_of(opcode) + ": the index gives it " + std::to_string(length) +
                                " bytes here, in a file of " + std::to_string(size));
  }
  bytes.resize(static_cast<std::size_t>(length));
  source->read(offset, bytes);
  RecordCursor cursor(bytes, offset);
  RawRecord record;
  if (!cursor.next(record) || record.opcode != opcode) {
    throw FileError(offset, name_of(record.opcode) + " where the index has a " + name_of(opcode));
  }
  return record;
}

Reader::Reader(const std::filesystem::path& path, const ReadLimits& limits)
    : Reader(open_file(path), limits) {}

Reader::Reader(std::shared_ptr<const Source> source, const ReadLimits& limits)
    : state_(std::make_shared<ReaderState>()) {
  state_->summary = naming_file(*source, [&] { return summary_of(source, limits); });
  state_->source = std::move(source);
  state_->limits = limits;
}

const Summary& Reader::summary() const {
  return state_->summary;
}

const Source& Reader::source() const {
  return *state_->source;
}

MessageCursor Reader::messages(const Selection& selection) {
  naming_file(*state_->source, [&] { state_->need_index(); });
  return {state_, selection};
}

OwnedAttachment Reader::attachment(const AttachmentIndex& index) const {
  return naming_file(*state_->source, [&] {
    OwnedAttachment owned;
    owned.attachment = decode_attachment(
        state_->read_record(Opcode::kAttachment, index.offset, index.length, owned.record));
    return owned;
  });
}

Metadata Reader::metadata(const MetadataIndex& index) const {
  return naming_file(*state_->source, [&] {
    std::vector<std::byte> bytes;
    return decode_metadata(
        state_->read_record(Opcode::kMetadata, index.offset, index.length, bytes));
  });
}

}  // namespace coop::mcap
