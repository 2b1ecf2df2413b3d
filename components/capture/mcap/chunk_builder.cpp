#include "capture/mcap/chunk_builder.hpp"

#include <algorithm>

#include "capture/mcap/crc.hpp"

namespace coop::mcap {

void ChunkBuilder::add(const Message& message) {
  entries_of(message.channel_id).push_back({message.log_time, records_.size()});
  encode(records_, message);
  if (slot_) slot_->publish(records_.view());
  const bool first = message_count_ == 0;
  start_time_ = first ? message.log_time : std::min(start_time_, message.log_time);
  end_time_ = first ? message.log_time : std::max(end_time_, message.log_time);
  ++message_count_;
}

std::vector<MessageIndexEntry>& ChunkBuilder::entries_of(std::uint16_t channel) {
  if (channel >= slot_of_channel_.size()) slot_of_channel_.resize(std::size_t{channel} + 1);
  std::uint32_t& slot = slot_of_channel_[channel];
  if (slot == 0) {
    if (channels_used_ == channels_.size()) channels_.emplace_back();
    channels_[channels_used_].channel_id = channel;
    slot = static_cast<std::uint32_t>(++channels_used_);
  }
  return channels_[slot - 1].entries;
}

void ChunkBuilder::clear() {
  if (slot_) slot_->clear();
  records_.clear();
  for (std::size_t i = 0; i < channels_used_; ++i) {
    slot_of_channel_[channels_[i].channel_id] = 0;
    channels_[i].entries.clear();
  }
  channels_used_ = 0;
  message_count_ = 0;
  start_time_ = end_time_ = 0;
}

ReadyChunk make_ready(const ChunkBuilder& builder, Compressor& compressor, ByteBuffer& buffer,
                      bool checksum) {
  ReadyChunk ready;
  ready.chunk.message_start_time = builder.start_time();
  ready.chunk.message_end_time = builder.end_time();
  ready.chunk.uncompressed_size = builder.size();
  ready.chunk.uncompressed_crc = checksum ? crc32_of(builder.records()) : 0;
  ready.chunk.compression = name_of(compressor.compression());
  ready.chunk.records = compressor.compress(builder.records(), buffer);
  ready.channels = builder.channels();
  return ready;
}

}  // namespace coop::mcap
