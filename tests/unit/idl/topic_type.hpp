#pragma once
#include <cstring>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <memory>
#include <optional>

#include "unit/idl/cdr_sample.hpp"

namespace coop::test {

using eprosima::fastdds::dds::TopicDataType;
using eprosima::fastrtps::rtps::SerializedPayload_t;

/// An object of a topic type known only by its TopicDataType.
using Sample = std::shared_ptr<void>;

inline Sample create_sample(TopicDataType& type) {
  return {type.createData(), [&type](void* data) { type.deleteData(data); }};
}

/// The object these bytes (with encapsulation) stand for, or nothing where they are malformed.
inline Sample decode(TopicDataType& type, const Bytes& bytes) {
  SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
  payload.length = static_cast<std::uint32_t>(bytes.size());
  if (!bytes.empty()) std::memcpy(payload.data, bytes.data(), bytes.size());
  Sample sample = create_sample(type);
  return type.deserialize(&payload, sample.get()) ? sample : nullptr;
}

/// The bytes of the object, padding set to zero; empty if it cannot be written.
inline Bytes encode(TopicDataType& type, const Sample& sample) {
  const std::uint32_t size = type.getSerializedSizeProvider(sample.get())();
  SerializedPayload_t payload(size);
  std::memset(payload.data, 0, size);
  if (!type.serialize(sample.get(), &payload)) return {};
  return {payload.data, payload.data + payload.length};
}

}  // namespace coop::test
