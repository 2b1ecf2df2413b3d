#include "capture/mcap/file_writer.hpp"

#include <algorithm>

namespace coop::mcap {

FileWriter::FileWriter(std::unique_ptr<Sink> sink, const Header& header, const Layout& layout)
    : sink_(std::move(sink)), layout_(layout) {
  buffer_.raw(kMagic);
  encode(buffer_, header, layout_.padding);
  write_buffer();
}

void FileWriter::write(std::span<const Bytes> parts) {
  sink_->write(parts);
  for (const Bytes part : parts) {
    size_ += part.size();
    if (layout_.data_crc) data_crc_.add(part);
  }
}

void FileWriter::write_buffer() {
  const Bytes part = buffer_.view();
  write({&part, 1});
  buffer_.clear();
}

bool FileWriter::note(const Schema& schema) {
  if (!schema_ids_.insert(schema.id).second) return false;
  schemas_.push_back(schema);
  ++statistics_.schema_count;
  return true;
}

bool FileWriter::note(const Channel& channel) {
  if (!channel_ids_.insert(channel.id).second) return false;
  channels_.push_back(channel);
  ++statistics_.channel_count;
  return true;
}

void FileWriter::add(const Schema& schema) {
  if (!note(schema)) return;
  buffer_.clear();
  encode(buffer_, schema, layout_.padding);
  write_buffer();
}

void FileWriter::add(const Channel& channel) {
  if (!note(channel)) return;
  buffer_.clear();
  encode(buffer_, channel, layout_.padding);
  write_buffer();
}

void FileWriter::count(std::uint16_t channel, std::uint64_t messages, Nanoseconds start,
                       Nanoseconds end) {
  const bool first = statistics_.message_count == 0;
  statistics_.message_start_time = first ? start : std::min(statistics_.message_start_time, start);
  statistics_.message_end_time = first ? end : std::max(statistics_.message_end_time, end);
  statistics_.message_count += messages;
  statistics_.channel_message_counts[channel] += messages;
}

void FileWriter::add(const Message& message) {
  buffer_.clear();
  encode(buffer_, message);
  write_buffer();
  count(message.channel_id, 1, message.log_time, message.log_time);
}

void FileWriter::add(const Attachment& attachment) {
  buffer_.clear();
  encode(buffer_, attachment, layout_.padding);
  const std::uint64_t offset = size_;
  write_buffer();
  ++statistics_.attachment_count;
  attachment_indexes_.push_back({offset, size_ - offset, attachment.log_time,
                                 attachment.create_time, attachment.data.size(), attachment.name,
                                 attachment.media_type});
}

void FileWriter::add(const Metadata& metadata) {
  buffer_.clear();
  encode(buffer_, metadata, layout_.padding);
  const std::uint64_t offset = size_;
  write_buffer();
  ++statistics_.metadata_count;
  metadata_indexes_.push_back({offset, size_ - offset, metadata.name});
}

void FileWriter::add(const ReadyChunk& ready, std::span<const Schema* const> schemas_before,
                     std::span<const Channel* const> channels_before) {
  buffer_.clear();
  for (const Schema* schema : schemas_before) {
    if (!schema_ids_.contains(schema->id)) encode(buffer_, *schema, layout_.padding);
  }
  for (const Channel* channel : channels_before) {
    if (!channel_ids_.contains(channel->id)) encode(buffer_, *channel, layout_.padding);
  }
  ChunkIndex index;
  index.chunk_start_offset = size_ + buffer_.size();
  const std::size_t chunk_begin = buffer_.size();
  encode_before_records(buffer_, ready.chunk);
  index.chunk_length = buffer_.size() - chunk_begin + ready.chunk.records.size();
  const std::uint64_t indexes_begin = index.chunk_start_offset + index.chunk_length;
  indexes_.clear();
  if (layout_.message_index) {
    for (const ChannelEntries& channel : ready.channels) {
      index.message_index_offsets.emplace_back(channel.channel_id, indexes_begin + indexes_.size());
      encode(indexes_, channel.channel_id, channel.entries, layout_.padding);
    }
  }
  write(std::array<Bytes, 3>{buffer_.view(), ready.chunk.records, indexes_.view()});
  // Counted only now: where the write fails, none of it is in the file.
  for (const Schema* schema : schemas_before) note(*schema);
  for (const Channel* channel : channels_before) note(*channel);
  for (const ChannelEntries& channel : ready.channels) {
    count(channel.channel_id, channel.entries.size(), ready.chunk.message_start_time,
          ready.chunk.message_end_time);
  }
  ++statistics_.chunk_count;
  index.message_start_time = ready.chunk.message_start_time;
  index.message_end_time = ready.chunk.message_end_time;
  index.message_index_length = indexes_.size();
  index.compression = ready.chunk.compression;
  index.compressed_size = ready.chunk.records.size();
  index.uncompressed_size = ready.chunk.uncompressed_size;
  chunk_indexes_.push_back(std::move(index));
}

Footer FileWriter::encode_summary(std::uint64_t begin) {
  std::vector<SummaryOffset> groups;
  const auto group = [&](Opcode opcode, bool wanted, const auto& records) {
    if (!wanted) return;
    const std::uint64_t start = size_ + buffer_.size();
    for (const auto& record : records) encode(buffer_, record, layout_.padding);
    const std::uint64_t length = size_ + buffer_.size() - start;
    if (length > 0) groups.push_back({opcode, start, length});
  };
  group(Opcode::kSchema, layout_.repeated_schemas, schemas_);
  group(Opcode::kChannel, layout_.repeated_channels, channels_);
  group(Opcode::kStatistics, layout_.statistics, std::span(&statistics_, 1));
  group(Opcode::kMetadataIndex, layout_.metadata_index, metadata_indexes_);
  group(Opcode::kAttachmentIndex, layout_.attachment_index, attachment_indexes_);
  group(Opcode::kChunkIndex, layout_.chunk_index, chunk_indexes_);
  Footer footer;
  footer.summary_start = groups.empty() ? 0 : begin;
  if (layout_.summary_offsets && !groups.empty()) {
    footer.summary_offset_start = size_ + buffer_.size();
    for (const SummaryOffset& offset : groups) encode(buffer_, offset, layout_.padding);
  }
  return footer;
}

void FileWriter::finish() {
  if (finished_) return;
  buffer_.clear();
  encode(buffer_, DataEnd{layout_.data_crc ? data_crc_.value() : 0});
  const std::size_t summary_begin = buffer_.size();
  Footer footer = encode_summary(size_ + summary_begin);
  encode(buffer_, footer);
  // The CRC is the last field of the footer and covers all of the summary before it.
  buffer_.resize(buffer_.size() - sizeof(footer.summary_crc));
  buffer_.u32(crc32_of(buffer_.view().subspan(summary_begin)));
  buffer_.raw(kMagic);
  write_buffer();
  finished_ = true;
}

}  // namespace coop::mcap
