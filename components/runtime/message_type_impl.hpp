#pragma once
#include <fastdds/rtps/common/InstanceHandle.h>

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
