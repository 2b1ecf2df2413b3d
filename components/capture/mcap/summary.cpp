#include "capture/mcap/summary.hpp"

#include <algorithm>

#include "capture/mcap/crc.hpp"
#include "capture/mcap/encode.hpp"

namespace coop::mcap {
namespace {

/// Where summary and footer lie, checked against the file's bounds.
struct Ending {
  Footer footer;
  std::uint64_t footer_offset = 0;
};

Ending read_ending(RecordStream& stream, std::uint64_t size, std::uint64_t data_begin) {
  constexpr std::uint64_t kEnding = kFooterRecord + kMagic.size();
  if (size < data_begin + kEnding) throw FileError(size, "the file ends before its Footer");
  const std::uint64_t offset = size - kEnding;
  if (!std::ranges::equal(stream.bytes(size - kMagic.size(), kMagic.size()), kMagic)) {
    throw FileError(size - kMagic.size(), "the file does not end with the magic: it is cut");
  }
  stream.seek(offset);
  const auto place = stream.next();
  if (!place || place->opcode != Opcode::kFooter || place->content_length != 20) {
    throw FileError(offset, "no Footer before the magic at the end");
  }
  Ending ending{decode_footer(stream.content()), offset};
  const std::uint64_t start = ending.footer.summary_start;
  if (start != 0 && (start < data_begin || start > offset)) {
    throw FileError(offset, "Footer: the summary cannot begin at byte " + std::to_string(start));
  }
  const std::uint64_t offsets = ending.footer.summary_offset_start;
  if (offsets != 0 && (offsets < start || offsets > offset)) {
    throw FileError(offset,
                    "Footer: the summary offsets cannot begin at byte " + std::to_string(offsets));
  }
  return ending;
}

void check_crc(const Ending& ending, Bytes summary) {
  if (ending.footer.summary_crc == 0) return;
  ByteBuffer covered;
  covered.raw(summary);
  encode(covered, ending.footer);
  const std::size_t without_crc = covered.size() - sizeof(ending.footer.summary_crc);
  if (crc32_of(covered.view().first(without_crc)) != ending.footer.summary_crc) {
    throw FileError(ending.footer.summary_start, "the summary has been damaged: its CRC differs");
  }
}

void check_bounds(const ChunkIndex& index, std::uint64_t offset, std::uint64_t data_end) {
  if (index.chunk_start_offset > data_end ||
      index.chunk_length > data_end - index.chunk_start_offset) {
    throw FileError(offset, "ChunkIndex: its chunk of " + std::to_string(index.chunk_length) +
                                " bytes at byte " + std::to_string(index.chunk_start_offset) +
                                " is not in the data section");
  }
}

/// What belongs in a summary wherever it is met.
void take(Summary& summary, const RawRecord& record) {
  if (record.opcode == Opcode::kSchema) {
    Schema schema = decode_schema(record);
    if (schema.id != 0) summary.schemas.try_emplace(schema.id, std::move(schema));
  } else if (record.opcode == Opcode::kChannel) {
    Channel channel = decode_channel(record);
    summary.channels.try_emplace(channel.id, std::move(channel));
  }
}

}  // namespace

const Schema* Summary::schema_of(const Channel& channel) const {
  const auto found = schemas.find(channel.schema_id);
  return found == schemas.end() ? nullptr : &found->second;
}

std::optional<Summary> read_summary(const std::shared_ptr<const Source>& source,
                                    const ReadLimits& limits) {
  FileBegin begin = read_begin(source, limits);
  const std::uint64_t size = source->size();
  RecordStream stream(source, limits, begin.data_begin, size);
  const Ending ending = read_ending(stream, size, begin.data_begin);
  const std::uint64_t start = ending.footer.summary_start;
  if (start == 0) return std::nullopt;
  const std::uint64_t length = ending.footer_offset - start;
  if (length > limits.max_record) {
    throw FileError(start, "a summary of " + std::to_string(length) + " bytes; at most " +
                               std::to_string(limits.max_record) + " are read");
  }
  const Bytes bytes = stream.bytes(start, length);
  check_crc(ending, bytes);
  Summary summary;
  summary.header = std::move(begin.header);
  RecordCursor records(bytes, start);
  RawRecord record;
  while (records.next(record)) {
    switch (record.opcode) {
      case Opcode::kStatistics:
        summary.statistics = decode_statistics(record);
        break;
      case Opcode::kAttachmentIndex:
        summary.attachments.push_back(decode_attachment_index(record));
        break;
      case Opcode::kMetadataIndex:
        summary.metadata.push_back(decode_metadata_index(record));
        break;
      case Opcode::kChunkIndex:
        summary.chunks.push_back(decode_chunk_index(record));
        check_bounds(summary.chunks.back(), record.offset, start);
        break;
      default:
        take(summary, record);
        break;
    }
  }
  std::ranges::stable_sort(summary.chunks, {}, &ChunkIndex::chunk_start_offset);
  return summary;
}

}  // namespace coop::mcap
