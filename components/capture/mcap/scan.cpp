#include <algorithm>
#include <set>

#include "capture/mcap/compression.hpp"
#include "capture/mcap/summary.hpp"

namespace coop::mcap {
namespace {

/// Runs of loose messages are read as a whole: at most this long, bytes, but for one larger
/// message.
constexpr std::uint64_t kLongestRun = std::uint64_t{4} << 20U;
/// What of an attachment is read for its index: not its data.
constexpr std::uint64_t kAttachmentHead = std::uint64_t{64} << 10U;

class Scan {
 public:
  Scan(const std::shared_ptr<const Source>& source, const ReadLimits& limits)
      : limits_(limits),
        begin_(read_begin(source, limits)),
        stream_(source, limits, begin_.data_begin, source->size()) {
    summary_.header = begin_.header;
    summary_.scanned = true;
    summary_.statistics.emplace();
  }

  Summary run() {
    summary_.complete = false;
    try {
      while (const auto place = stream_.next()) {
        if (place->opcode == Opcode::kDataEnd) {
          summary_.complete = true;
          break;
        }
        // A file may lack DataEnd: the Footer is as good an end of the data.
        if (place->opcode == Opcode::kFooter) {
          summary_.complete = true;
          break;
        }
        take(*place);
      }
      if (!summary_.complete) {
        summary_.defect = FileError(stream_.position(), "the file ends without DataEnd").what();
      }
    } catch (const FileError& error) {
      summary_.defect = error.what();
    }
    check_message_indexes();
    Statistics& statistics = *summary_.statistics;
    summary_.schemas.erase(0);
    statistics.schema_count = static_cast<std::uint16_t>(summary_.schemas.size());
    statistics.channel_count = static_cast<std::uint32_t>(summary_.channels.size());
    return std::move(summary_);
  }

 private:
  void take(const RecordStream::Place& place) {
    switch (place.opcode) {
      case Opcode::kSchema:
      case Opcode::kChannel:
        take_definition(stream_.content());
        break;
      case Opcode::kMessage:
        take_loose(place, decode_message(stream_.content()));
        break;
      case Opcode::kChunk:
        take_chunk(place);
        break;
      case Opcode::kMessageIndex:
        take_message_index(place);
        break;
      case Opcode::kAttachment:
        take_attachment(place);
        break;
      case Opcode::kMetadata:
        summary_.metadata.push_back(
            {place.offset, place.end() - place.offset, decode_metadata(stream_.content()).name});
        ++summary_.statistics->metadata_count;
        break;
      default:
        break;
    }
  }

  void take_definition(const RawRecord& record) {
    if (record.opcode == Opcode::kSchema) {
      Schema schema = decode_schema(record);
      summary_.schemas.try_emplace(schema.id, std::move(schema));
    } else {
      Channel channel = decode_channel(record);
      summary_.channels.try_emplace(channel.id, std::move(channel));
    }
  }

  void count(const Message& message) {
    Statistics& statistics = *summary_.statistics;
    const bool first = statistics.message_count == 0;
    statistics.message_start_time =
        first ? message.log_time : std::min(statistics.message_start_time, message.log_time);
    statistics.message_end_time = std::max(statistics.message_end_time, message.log_time);
    ++statistics.message_count;
    ++statistics.channel_message_counts[message.channel_id];
  }

  void take_loose(const RecordStream::Place& place, const Message& message) {
    count(message);
    std::vector<LooseRun>& runs = summary_.loose;
    const bool continues = !runs.empty() &&
                           runs.back().offset + runs.back().length == place.offset &&
                           place.end() - runs.back().offset <= kLongestRun;
    if (!continues) runs.push_back({place.offset, 0, message.log_time, message.log_time});
    LooseRun& run = runs.back();
    run.length = place.end() - run.offset;
    run.start_time = std::min(run.start_time, message.log_time);
    run.end_time = std::max(run.end_time, message.log_time);
  }

  /// Uncompressed, since schemas and channels may be in there; its times are taken from its
  /// messages, not from its head.
  void take_chunk(const RecordStream::Place& place) {
    check_message_indexes();
    const Chunk chunk = decode_chunk(stream_.content());
    decompressor_.decompress(chunk, place.offset, limits_.max_chunk, records_);
    ChunkIndex index;
    index.chunk_start_offset = place.offset;
    index.chunk_length = place.end() - place.offset;
    index.compression = chunk.compression;
    index.compressed_size = chunk.records.size();
    index.uncompressed_size = chunk.uncompressed_size;
    RecordCursor cursor(records_, 0, place.offset);
    RawRecord record;
    bool first = true;
    while (cursor.next(record)) {
      if (record.opcode == Opcode::kSchema || record.opcode == Opcode::kChannel) {
        take_definition(record);
      } else if (record.opcode == Opcode::kMessage) {
        const Message message = decode_message({record.opcode, place.offset, record.content});
        count(message);
        channels_of_chunk_.insert(message.channel_id);
        index.message_start_time =
            first ? message.log_time : std::min(index.message_start_time, message.log_time);
        index.message_end_time = std::max(index.message_end_time, message.log_time);
        first = false;
      }
    }
    ++summary_.statistics->chunk_count;
    summary_.chunks.push_back(std::move(index));
  }

  /// A chunk's indexes tell which channels it has only if there is one for each.
  void check_message_indexes() {
    if (!summary_.chunks.empty() &&
        summary_.chunks.back().message_index_offsets.size() != channels_of_chunk_.size()) {
      summary_.chunks.back().message_index_offsets.clear();
    }
    channels_of_chunk_.clear();
  }

  void take_message_index(const RecordStream::Place& place) {
    if (summary_.chunks.empty()) return;
    ChunkIndex& chunk = summary_.chunks.back();
    if (chunk.chunk_start_offset + chunk.chunk_length + chunk.message_index_length !=
        place.offset) {
      return;
    }
    const MessageIndex index = decode_message_index(stream_.content());
    chunk.message_index_length += place.end() - place.offset;
    chunk.message_index_offsets.emplace_back(index.channel_id, place.offset);
  }

  void take_attachment(const RecordStream::Place& place) {
    Decoder in(stream_.content_prefix(kAttachmentHead));
    AttachmentIndex index;
    index.offset = place.offset;
    index.length = place.end() - place.offset;
    index.log_time = in.u64("log time");
    index.create_time = in.u64("create time");
    index.name = in.string("name");
    index.media_type = in.string("media type");
    index.data_size = in.u64("data size");
    summary_.attachments.push_back(std::move(index));
    ++summary_.statistics->attachment_count;
  }

  ReadLimits limits_;
  FileBegin begin_;
  RecordStream stream_;
  Summary summary_;
  Decompressor decompressor_;
  std::vector<std::byte> records_;
  std::set<std::uint16_t> channels_of_chunk_;
};

}  // namespace

Summary scan(const std::shared_ptr<const Source>& source, const ReadLimits& limits) {
  return Scan(source, limits).run();
}

}  // namespace coop::mcap
