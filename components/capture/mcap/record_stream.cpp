#include "capture/mcap/record_stream.hpp"

#include <algorithm>

namespace coop::mcap {
namespace {
constexpr std::uint64_t kWindow = std::uint64_t{256} << 10U;
}

RecordStream::RecordStream(std::shared_ptr<const Source> source, const ReadLimits& limits,
                           std::uint64_t offset, std::uint64_t end)
    : source_(std::move(source)), limits_(limits), position_(offset), end_(end) {}

Bytes RecordStream::bytes(std::uint64_t offset, std::uint64_t length) {
  const bool inside = offset >= window_begin_ && offset - window_begin_ <= window_size_ &&
                      length <= window_size_ - (offset - window_begin_);
  if (!inside) {
    const std::uint64_t wanted = std::min(std::max(length, kWindow), end_ - offset);
    if (window_.size() < wanted) window_.resize(static_cast<std::size_t>(wanted));
    window_size_ = 0;
    source_->read(offset, std::span(window_).first(static_cast<std::size_t>(wanted)));
    window_begin_ = offset;
    window_size_ = static_cast<std::size_t>(wanted);
  }
  return Bytes(window_).subspan(static_cast<std::size_t>(offset - window_begin_),
                                static_cast<std::size_t>(length));
}

std::optional<RecordStream::Place> RecordStream::next() {
  if (position_ >= end_) return std::nullopt;
  const std::uint64_t left = end_ - position_;
  if (left < kRecordPrefix) {
    throw FileError(position_, "a record begins " + std::to_string(left) + " bytes before the end");
  }
  const Bytes prefix = bytes(position_, kRecordPrefix);
  Place place{static_cast<Opcode>(prefix[0]), position_, load_u64(prefix.subspan(1))};
  if (place.opcode == Opcode{}) throw FileError(position_, "0 is no opcode");
  if (place.content_length > left - kRecordPrefix) {
    throw FileError(position_, name_of(place.opcode) + ": " + std::to_string(place.content_length) +
                                   " bytes long where " + std::to_string(left - kRecordPrefix) +
                                   " are left");
  }
  place_ = place;
  position_ = place.end();
  return place_;
}

RawRecord RecordStream::content() {
  return content_prefix(place_.content_length);
}

RawRecord RecordStream::content_prefix(std::uint64_t length) {
  length = std::min(length, place_.content_length);
  if (length > limits_.max_record) {
    throw FileError(place_.offset, name_of(place_.opcode) + ": " + std::to_string(length) +
                                       " bytes long; at most " +
                                       std::to_string(limits_.max_record) + " are read");
  }
  return {place_.opcode, place_.offset, bytes(place_.offset + kRecordPrefix, length)};
}

FileBegin read_begin(const std::shared_ptr<const Source>& source, const ReadLimits& limits) {
  const std::uint64_t size = source->size();
  RecordStream stream(source, limits, kMagic.size(), size);
  if (size < kMagic.size() || !std::ranges::equal(stream.bytes(0, kMagic.size()), kMagic)) {
    throw FileError(0, "this is no MCAP file: it does not begin with the magic of MCAP 0");
  }
  const auto place = stream.next();
  if (!place || place->opcode != Opcode::kHeader) {
    throw FileError(kMagic.size(), "no Header after the magic" +
                                       (place ? ", but " + name_of(place->opcode) : std::string()));
  }
  return {decode_header(stream.content()), place->end()};
}

}  // namespace coop::mcap
