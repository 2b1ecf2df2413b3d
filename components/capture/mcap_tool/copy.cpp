#include "capture/mcap_tool/copy.hpp"

#include <algorithm>

namespace coop::mcap {

void Copy::message(const ReadMessage& read) {
  auto known = channels_.find(read.channel);
  if (known == channels_.end()) {
    const Schema* schema = read.schema;
    const std::uint16_t schema_id =
        schema == nullptr ? std::uint16_t{0}
                          : writer_.add_schema(schema->name, schema->encoding, schema->data);
    const std::uint16_t channel = writer_.add_channel(
        schema_id, read.channel->topic, read.channel->message_encoding, read.channel->metadata);
    known = channels_.emplace(read.channel, channel).first;
  }
  Message message = read.message;
  message.channel_id = known->second;
  writer_.write(message);
}

void Copy::attachments(const Reader& reader) {
  for (const AttachmentIndex& index : reader.summary().attachments) {
    writer_.attach(reader.attachment(index).attachment);
  }
}

void Copy::metadata(const Reader& reader) {
  for (const MetadataIndex& index : reader.summary().metadata) {
    writer_.add(reader.metadata(index));
  }
}

void copy_selected(Reader& reader, const Selection& selection, Writer& writer) {
  Copy copy(writer);
  copy.attachments(reader);
  copy.metadata(reader);
  MessageCursor cursor = reader.messages(selection);
  while (const auto read = cursor.next()) copy.message(*read);
}

void merge(std::span<Reader> readers, Writer& writer) {
  Copy copy(writer);
  struct Input {
    MessageCursor cursor;
    std::optional<ReadMessage> head;
  };
  std::vector<Input> inputs;
  for (Reader& reader : readers) {
    copy.attachments(reader);
    copy.metadata(reader);
    inputs.push_back({reader.messages(), std::nullopt});
    inputs.back().head = inputs.back().cursor.next();
  }
  while (true) {
    Input* first = nullptr;
    for (Input& input : inputs) {
      if (input.head &&
          (first == nullptr || input.head->message.log_time < first->head->message.log_time)) {
        first = &input;
      }
    }
    if (first == nullptr) return;
    copy.message(*first->head);
    first->head = first->cursor.next();
  }
}

}  // namespace coop::mcap
