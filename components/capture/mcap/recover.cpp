#include "capture/mcap/recover.hpp"

#include <algorithm>

#include "capture/mcap/chunk_search.hpp"
#include "capture/mcap/summary.hpp"

namespace coop::mcap {
namespace {

class Recovery {
 public:
  Recovery(const std::shared_ptr<const Source>& source, std::unique_ptr<Sink> sink,
           const RecoverOptions& options)
      : options_(options),
        begin_(read_begin(source, options.limits)),
        stream_(source, options.limits, begin_.data_begin, source->size()),
        out_(std::move(sink), begin_.header, options.layout),
        compressor_(options.compression, options.level),
        // False chunks found in garbage cost time; what they may cost together is bounded.
        search_from_(begin_.data_begin),
        waste_left_(16 * source->size() + (std::uint64_t{64} << 20U)) {
    take_definitions_of_summary(source);
  }

  RecoverReport run() {
    while (!ended_ && step()) {
    }
    flush_salvaged();
    out_.finish();
    report_.messages = out_.statistics().message_count;
    report_.attachments = out_.statistics().attachment_count;
    report_.metadata = out_.statistics().metadata_count;
    report_.was_complete = summary_was_good_ && report_.notes.empty();
    report_.channels = channels_;
    return std::move(report_);
  }

 private:
  /// Channels that damage has taken from the data section may be in the summary.
  void take_definitions_of_summary(const std::shared_ptr<const Source>& source) {
    try {
      if (const auto summary = read_summary(source, options_.limits)) {
        schemas_ = summary->schemas;
        channels_ = summary->channels;
      }
      summary_was_good_ = true;
    } catch (const FileError& error) {
      note(error);
    }
  }

  void note(const FileError& error) {
    if (report_.notes.size() < RecoverReport::kMostNotes) {
      report_.notes.emplace_back(error.what());
    } else {
      ++report_.further_notes;
    }
  }

  /// One record. False at the end of the file.
  bool step() {
    const std::uint64_t offset = stream_.position();
    try {
      const auto place = stream_.next();
      if (!place) {
        note(FileError(offset, "the file ends without DataEnd"));
        return false;
      }
      if (place->opcode > Opcode::kDataEnd && !is_end_or_record(place->end())) {
        throw FileError(offset, name_of(place->opcode) + " where a record should begin");
      }
      take(*place);
      // A chunk that is good is not looked into again; of another record the length may be wrong.
      const bool checked = place->opcode == Opcode::kChunk || place->opcode == Opcode::kAttachment;
      search_from_ = std::max(search_from_, checked ? place->end() : offset + 1);
    } catch (const FileError& error) {
      note(error);
      if (!salvage_cut_chunk(offset)) resume_after(offset);
    }
    return true;
  }

  [[nodiscard]] bool is_end_or_record(std::uint64_t offset) {
    return offset == stream_.end() || is_plausible_record(stream_, offset);
  }

  /// Behind the damaged record if there is one, else at the next chunk: that may lie in the record
  /// before, should its length be what is damaged.
  void resume_after(std::uint64_t offset) {
    const std::uint64_t behind = stream_.position();
    const bool is_record = behind > offset;
    if (is_record && is_plausible_record(stream_, behind)) return;
    const std::uint64_t from = is_record ? std::max(search_from_, offset + 1) : search_from_;
    const std::uint64_t found = find_chunk(stream_, from);
    search_from_ = found + 1;
    if (found > offset) {
      report_.skipped_bytes += found - offset;
    } else {
      spend(offset - found);
    }
    stream_.seek(found);
  }

  /// What damage makes us read twice.
  void spend(std::uint64_t bytes) {
    if (bytes > waste_left_) {
      note(FileError(stream_.position(), "too much damage: the rest is given up"));
      ended_ = true;
    }
    waste_left_ -= std::min(bytes, waste_left_);
  }

  void take(const RecordStream::Place& place) {
    switch (place.opcode) {
      case Opcode::kSchema:
      case Opcode::kChannel:
        take_definition(stream_.content());
        break;
      case Opcode::kMessage:
        take_loose(decode_message(stream_.content()));
        break;
      case Opcode::kChunk:
        take_chunk(place);
        break;
      case Opcode::kMessageIndex:
        take_message_index();
        break;
      case Opcode::kAttachment:
        take_attachment();
        break;
      case Opcode::kMetadata:
        out_.add(decode_metadata(stream_.content()));
        break;
      case Opcode::kDataEnd:
      case Opcode::kFooter:
        ended_ = true;
        break;
      default:
        break;
    }
    if (place.opcode != Opcode::kMessageIndex && place.opcode != Opcode::kChunk) {
      after_lost_chunk_ = false;
    }
  }

  void take_definition(const RawRecord& record) {
    if (record.opcode == Opcode::kSchema) {
      Schema schema = decode_schema(record);
      if (schema.id != 0) schemas_.try_emplace(schema.id, std::move(schema));
    } else {
      Channel channel = decode_channel(record);
      channels_.try_emplace(channel.id, std::move(channel));
    }
  }

  void take_attachment() {
    try {
      out_.add(decode_attachment(stream_.content()));
    } catch (const FileError&) {
      ++report_.lost_attachments;
      throw;
    }
  }

  void take_loose(const Message& message) {
    if (!channels_.contains(message.channel_id)) {
      ++report_.lost_messages[message.channel_id];
      throw FileError(stream_.position(), "a message of channel " +
                                              std::to_string(message.channel_id) +
                                              ", which the file does not describe");
    }
    salvaged_.add(message);
    ++report_.salvaged_messages;
    if (salvaged_.size() >= (std::size_t{4} << 20U)) flush_salvaged();
  }

  void take_chunk(const RecordStream::Place& place) {
    after_lost_chunk_ = false;
    try {
      const Chunk chunk = decode_chunk(stream_.content());
      decompressor_.decompress(chunk, place.offset, options_.limits.max_chunk, records_);
      entries_.clear();
      if (!read_entries(place.offset)) {
        salvage_records(place.offset);
        note(
            FileError(place.offset, "Chunk: messages of channels that the file does not describe"));
        return;
      }
      copy_chunk(chunk);
    } catch (const FileError&) {
      ++report_.lost_chunks;
      after_lost_chunk_ = true;
      spend(place.content_length);
      throw;
    }
  }

  /// Where the messages of the records are. False if some are of unknown channels.
  bool read_entries(std::uint64_t offset) {
    bool all_known = true;
    RecordCursor cursor(records_, 0, offset);
    RawRecord record;
    while (cursor.next(record)) {
      if (record.opcode == Opcode::kSchema || record.opcode == Opcode::kChannel) {
        take_definition(record);
      } else if (record.opcode == Opcode::kMessage) {
        const Message message = decode_message(record);
        all_known = all_known && channels_.contains(message.channel_id);
        entries_[message.channel_id].push_back({message.log_time, record.offset});
      }
    }
    return all_known;
  }

  void copy_chunk(Chunk chunk) {
    flush_salvaged();
    ReadyChunk ready;
    std::vector<ChannelEntries> channels;
    bool first = true;
    for (auto& [id, entries] : entries_) {
      for (const MessageIndexEntry& entry : entries) {
        chunk.message_start_time =
            first ? entry.log_time : std::min(chunk.message_start_time, entry.log_time);
        chunk.message_end_time =
            first ? entry.log_time : std::max(chunk.message_end_time, entry.log_time);
        first = false;
      }
      channels.push_back({id, std::move(entries)});
    }
    ready.chunk = std::move(chunk);
    ready.channels = channels;
    write(ready);
    ++report_.chunks;
  }

  /// The whole messages of records that may break off, one by one.
  std::uint64_t salvage_records(std::uint64_t offset) {
    std::uint64_t messages = 0;
    RecordCursor cursor(records_, 0, offset);
    RawRecord record;
    try {
      while (cursor.next(record)) {
        if (record.opcode == Opcode::kSchema || record.opcode == Opcode::kChannel) {
          take_definition(record);
        } else if (record.opcode == Opcode::kMessage) {
          const Message message = decode_message(record);
          if (channels_.contains(message.channel_id)) {
            take_loose(message);
            ++messages;
          } else {
            ++report_.lost_messages[message.channel_id];
          }
        }
      }
    } catch (const FileError&) {
      // Here it breaks off.
    }
    return messages;
  }

  /// A chunk that reaches beyond the end of the file: what a killed writer leaves.
  bool salvage_cut_chunk(std::uint64_t offset) {
    constexpr std::uint64_t kHead = kRecordPrefix + 44;
    const std::uint64_t left = stream_.end() - offset;
    if (left < kHead) return false;
    const Bytes prefix = stream_.bytes(offset, kHead);
    const std::uint64_t length = load_u64(prefix.subspan(1));
    if (static_cast<Opcode>(prefix[0]) != Opcode::kChunk || length <= left - kRecordPrefix) {
      return false;
    }
    try {
      ChunkHead head =
          decode_chunk_head({Opcode::kChunk, offset, prefix.subspan(kRecordPrefix)}, length);
      const std::uint64_t begin = offset + kRecordPrefix + head.records_offset;
      if (find_chunk(stream_, offset + 1) != stream_.end()) return false;
      head.chunk.records =
          stream_.bytes(begin, std::min(stream_.end() - begin, options_.limits.max_record));
      decompressor_.decompress_prefix(head.chunk, options_.limits.max_chunk, records_);
    } catch (const FileError&) {
      return false;
    }
    const std::uint64_t messages = salvage_records(offset);
    note(FileError(offset, "Chunk: cut off; " + std::to_string(messages) +
                               " messages before the cut are saved"));
    ++report_.lost_chunks;
    stream_.seek(stream_.end());
    ended_ = true;
    return true;
  }

  void flush_salvaged() {
    if (salvaged_.empty()) return;
    write(make_ready(salvaged_, compressor_, buffer_));
    salvaged_.clear();
  }

  void write(const ReadyChunk& ready) {
    std::vector<const Schema*> schemas;
    std::vector<const Channel*> channels;
    for (const auto& [id, schema] : schemas_) {
      if (!out_.has_schema(id)) schemas.push_back(&schema);
    }
    for (const auto& [id, channel] : channels_) {
      if (!out_.has_channel(id)) channels.push_back(&channel);
    }
    out_.add(ready, schemas, channels);
  }

  void take_message_index() {
    if (!after_lost_chunk_) return;
    const MessageIndex index = decode_message_index(stream_.content());
    report_.lost_messages[index.channel_id] += index.entries.size();
  }

  RecoverOptions options_;
  FileBegin begin_;
  RecordStream stream_;
  FileWriter out_;
  RecoverReport report_;
  Decompressor decompressor_;
  Compressor compressor_;
  ByteBuffer buffer_;
  std::vector<std::byte> records_;
  std::map<std::uint16_t, std::vector<MessageIndexEntry>> entries_;
  std::map<std::uint16_t, Schema> schemas_;
  std::map<std::uint16_t, Channel> channels_;
  ChunkBuilder salvaged_;
  std::uint64_t search_from_;  // for chunks, after damage
  std::uint64_t waste_left_;
  bool summary_was_good_ = false;
  bool after_lost_chunk_ = false;
  bool ended_ = false;
};

}  // namespace

RecoverReport recover(const std::shared_ptr<const Source>& source, std::unique_ptr<Sink> sink,
                      const RecoverOptions& options) {
  return Recovery(source, std::move(sink), options).run();
}

}  // namespace coop::mcap
