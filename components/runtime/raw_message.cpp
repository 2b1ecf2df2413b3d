#include "runtime/raw_message.hpp"

#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/common/InstanceHandle.h>
#include <fastdds/rtps/common/SerializedPayload.h>

#include <algorithm>
#include <cstring>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <sstream>

namespace coop::runtime {
namespace {

using Bytes = std::vector<std::uint8_t>;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

constexpr std::uint32_t kEncapsulation = 4;

/// Copies payloads instead of reading them.
class RawDdsType : public eprosima::fastdds::dds::TopicDataType {
 public:
  explicit RawDdsType(const RawMessageType& type, bool keyed) : type_(type) {
    setName(type_.name().c_str());
    m_typeSize = 512;  // where payloads begin; they grow
    m_isGetKeyDefined = keyed;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<const Bytes*>(data);
    if (bytes.size() < kEncapsulation || bytes.size() > payload->max_size) return false;
    std::ranges::copy(bytes, payload->data);
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = bytes[1] == 0 ? CDR_BE : CDR_LE;
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const auto size = static_cast<std::uint32_t>(static_cast<const Bytes*>(data)->size());
    return [size] { return size; };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void* data, InstanceHandle_t* handle, bool) override {
    if (!m_isGetKeyDefined) return false;
    const std::string key = type_.key_of(data);
    for (std::size_t i = 0; i < 16; ++i) {
      handle->value[i] = i < key.size() ? static_cast<std::uint8_t>(key[i]) : std::uint8_t{0};
    }
    return true;
  }
  [[nodiscard]] bool is_bounded() const override { return false; }
  [[nodiscard]] bool is_plain() const override { return false; }

 private:
  RawMessageType type_;
};

}  // namespace

std::string EndpointId::text() const {
  eprosima::fastrtps::rtps::GUID_t guid;
  std::memcpy(guid.guidPrefix.value, bytes.data(), 12);
  std::memcpy(guid.entityId.value, bytes.data() + 12, 4);
  std::ostringstream out;
  out << guid;
  return std::move(out).str();
}

RawMessageType::RawMessageType(std::string dds_type, bool keyed)
    : name_(std::move(dds_type)), keyed_(keyed) {}

std::shared_ptr<void> RawMessageType::create() const {
  return std::make_shared<Bytes>();
}

std::shared_ptr<const void> RawMessageType::clone(const void* message) const {
  return std::make_shared<const Bytes>(*static_cast<const Bytes*>(message));
}

std::string RawMessageType::key_of(const void* message) const {
  if (!keyed_) return {};
  if (const MessageType* known = find_message_type(name_)) {
    const std::shared_ptr<void> typed = known->create();
    if (known->deserialize(*static_cast<const Bytes*>(message), typed.get())) {
      return known->key_of(typed.get());
    }
  }
  return std::string(1, '\1');
}

void RawMessageType::serialize(const void* message, Bytes& out) const {
  out = *static_cast<const Bytes*>(message);
}

bool RawMessageType::deserialize(const Bytes& bytes, void* message) const {
  *static_cast<Bytes*>(message) = bytes;
  return true;
}

eprosima::fastdds::dds::TopicDataType* RawMessageType::new_dds_type() const {
  return new RawDdsType(*this, keyed_);
}

}  // namespace coop::runtime
