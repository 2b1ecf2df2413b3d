#pragma once
#include <fastdds/rtps/common/InstanceHandle.h>
#include <fastdds/rtps/common/SerializedPayload.h>

#include <algorithm>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include "runtime/message_type.hpp"

namespace coop::runtime {

/// Behind message_type<M>(): instantiated once a type by the sources that CMake writes from
/// type_table.cpp.in.
template <class Message, class PubSubType>
class IdlMessageType : public MessageType {
 public:
  IdlMessageType() : name_(PubSubType().getName()) {}

  const std::string& name() const override { return name_; }
  std::shared_ptr<void> create() const override { return std::make_shared<Message>(); }
  std::shared_ptr<const void> clone(const void* message) const override {
    return std::make_shared<const Message>(*static_cast<const Message*>(message));
  }
  std::string key_of(const void* message) const override {
    PubSubType type;
    if (!type.m_isGetKeyDefined) return {};
    eprosima::fastrtps::rtps::InstanceHandle_t handle;
    // The generated signature takes a mutable pointer but only reads.
    type.getKey(const_cast<void*>(message), &handle, false);
    return {reinterpret_cast<const char*>(&handle.value[0]), 16};
  }
  void serialize(const void* message, std::vector<std::uint8_t>& out) const override {
    PubSubType type;
    auto* mutable_message = const_cast<void*>(message);
    eprosima::fastrtps::rtps::SerializedPayload_t payload(
        type.getSerializedSizeProvider(mutable_message)());
    // The serialiser steps over padding without writing it.
    std::fill_n(payload.data, payload.max_size, std::uint8_t{0});
    if (!type.serialize(mutable_message, &payload)) payload.length = 0;
    out.assign(payload.data, payload.data + payload.length);
  }
  bool deserialize(const std::vector<std::uint8_t>& bytes, void* message) const override {
    constexpr std::size_t kEncapsulation = 4;
    if (bytes.size() < kEncapsulation) return false;
    PubSubType type;
    eprosima::fastrtps::rtps::SerializedPayload_t payload(static_cast<std::uint32_t>(bytes.size()));
    std::ranges::copy(bytes, payload.data);
    payload.length = static_cast<std::uint32_t>(bytes.size());
    return type.deserialize(&payload, message);
  }
  eprosima::fastdds::dds::TopicDataType* new_dds_type() const override {
    auto* type = new PubSubType();
    // Cyclone DDS refuses endpoints whose TypeObject it cannot read.
    type->auto_fill_type_object(false);
    type->auto_fill_type_information(false);
    return type;
  }

 private:
  std::string name_;
};

}  // namespace coop::runtime
