#pragma once
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <gtest/gtest.h>

#include "unit/idl/cdr_sample.hpp"

namespace coop::test {

/// The bytes read into the generated type and written by it again.
template <class T>
Bytes reencode(const Bytes& bytes) {
  Bytes copy = bytes;
  eprosima::fastcdr::FastBuffer in(reinterpret_cast<char*>(copy.data()), copy.size());
  eprosima::fastcdr::Cdr reader(in, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                                eprosima::fastcdr::Cdr::DDS_CDR);
  reader.read_encapsulation();
  T value;
  value.deserialize(reader);

  Bytes result(bytes.size());
  eprosima::fastcdr::FastBuffer out(reinterpret_cast<char*>(result.data()), result.size());
  eprosima::fastcdr::Cdr writer(out, eprosima::fastcdr::Cdr::DEFAULT_ENDIAN,
                                eprosima::fastcdr::Cdr::DDS_CDR);
  writer.serialize_encapsulation();
  value.serialize(writer);
  EXPECT_EQ(writer.getSerializedDataLength(), bytes.size());
  return result;
}

}  // namespace coop::test
