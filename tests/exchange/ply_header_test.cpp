#include "keyline/exchange/mesh/ply_header.h"

#include <bit>
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

/// PLY, by its format.
namespace keyline::exchange::detail {
namespace {

std::string header(const std::string& lines) { return "ply\n" + lines + "end_header\n"; }

TEST(PlyHeader, ReadsElementsAndProperties) {
  const std::string text =
      header(
          "format ascii 1.0\ncomment any\nobj_info any\nelement vertex 3\nproperty float x\n"
          "property double y\nelement face 2\nproperty list uchar int vertex_index\n") +
      "1 2";
  const auto found = read_ply_header(text);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->binary || found->big_endian);
  ASSERT_EQ(found->elements.size(), 2U);
  EXPECT_EQ(found->elements[0].name, "vertex");
  EXPECT_EQ(found->elements[0].count, 3U);
  EXPECT_EQ(found->elements[0].properties[1].name, "y");
  EXPECT_EQ(found->elements[0].properties[1].type, PlyType::float64);
  EXPECT_FALSE(found->elements[0].properties[1].count);
  EXPECT_EQ(found->elements[1].properties[0].count, PlyType::uint8);
  EXPECT_EQ(found->elements[1].properties[0].type, PlyType::int32);
  EXPECT_EQ(text.substr(found->size), "1 2");
  EXPECT_EQ(found->lines, 10U);
}

TEST(PlyHeader, TypesHaveTwoNamesAndOneSize) {
  struct Case {
    const char *old, *sized;
    std::size_t size;
  };
  for (const Case& c : {Case{"char", "int8", 1},
                        {"uchar", "uint8", 1},
                        {"short", "int16", 2},
                        {"ushort", "uint16", 2},
                        {"int", "int32", 4},
                        {"uint", "uint32", 4},
                        {"float", "float32", 4},
                        {"double", "float64", 8}}) {
    const auto type = [](const char* name) {
      const auto found = read_ply_header(
          header(std::string("format ascii 1.0\nelement v 1\nproperty ") + name + " x\n"));
      return found.value().elements[0].properties[0].type;
    };
    EXPECT_EQ(type(c.old), type(c.sized)) << c.old;
    EXPECT_EQ(size_of(type(c.old)), c.size) << c.old;
  }
}

TEST(PlyHeader, WhatCannotBeReadIsNamed) {
  const auto place = [](const std::string& text) {
    const auto found = read_ply_header(text);
    return found ? std::string() : found.error().path;
  };
  EXPECT_EQ(place("plx\n"), "line 1");
  EXPECT_EQ(place(""), "line 1");
  EXPECT_EQ(place("ply \nend_header\n"), "");
  EXPECT_EQ(place(header("format text 1.0\n")), "line 2");
  EXPECT_EQ(place(header("format ascii 1.0\nproperty float x\n")), "line 3");
  EXPECT_EQ(place(header("element v 1\nproperty real x\n")), "line 3");
  EXPECT_EQ(place(header("element v 1\nproperty list float8 int x\n")), "line 3");
  EXPECT_EQ(place(header("element v -1\n")), "line 2");
  EXPECT_EQ(place(header("element v 4000000000\n")), "");
  EXPECT_EQ(place(header("element v 4000000001\n")), "line 2");
  EXPECT_EQ(place(header("nonsense\n")), "line 2");
  EXPECT_EQ(place("ply\nformat ascii 1.0\n"), "line 2");
  EXPECT_TRUE(read_ply_header(header("format binary_big_endian 1.0\n"))->big_endian);
  EXPECT_FALSE(read_ply_header(header("format binary_little_endian 1.0\n"))->big_endian);
  EXPECT_TRUE(read_ply_header(header("format binary_little_endian 1.0\n"))->binary);
}

// The same bits in either order of bytes.
TEST(PlyValues, BinaryValuesAreOfTheirTypes) {
  for (const bool big : {false, true}) {
    std::string bytes;
    const auto put = [&](std::uint64_t bits, int size) {
      for (int i = 0; i < size; ++i)
        bytes += static_cast<char>(bits >> (8 * (big ? size - 1 - i : i)) & 255);
    };
    put(0xfe, 1);
    put(0xfe, 1);
    put(0xfffd, 2);
    put(0xfffd, 2);
    put(0xfffffffc, 4);
    put(0xfffffffc, 4);
    put(std::bit_cast<std::uint32_t>(1.5f), 4);
    put(std::bit_cast<std::uint64_t>(-2.25), 8);
    PlyHeader head;
    head.binary = true;
    head.big_endian = big;
    PlyValues values(bytes, head);
    using enum PlyType;
    EXPECT_EQ(values.next(int8).value(), -2);
    EXPECT_EQ(values.next(uint8).value(), 254);
    EXPECT_EQ(values.next(int16).value(), -3);
    EXPECT_EQ(values.next(uint16).value(), 65533);
    EXPECT_EQ(values.next(int32).value(), -4);
    EXPECT_EQ(values.next(uint32).value(), 4294967292.0);
    EXPECT_EQ(values.next(float32).value(), 1.5);
    EXPECT_EQ(values.next(float64).value(), -2.25);
    EXPECT_EQ(values.position(), 26U);
    const auto beyond = values.next(int8);
    ASSERT_FALSE(beyond);
    EXPECT_EQ(beyond.error().path, "byte 26");
  }
}

TEST(PlyValues, WordsAreNumbersInTheirLines) {
  PlyHeader head;
  head.lines = 7;
  PlyValues values("1 -2.5\n\n3 x", head);
  EXPECT_EQ(values.next(PlyType::int8).value(), 1);
  EXPECT_EQ(values.next(PlyType::int8).value(), -2.5);
  EXPECT_TRUE(values.more());
  EXPECT_EQ(values.next(PlyType::int8).value(), 3);
  const auto none = values.next(PlyType::int8);
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().path, "line 10");
  PlyValues few("1 \n ", head);
  static_cast<void>(few.next(PlyType::int8));
  EXPECT_FALSE(few.more());
  EXPECT_FALSE(few.next(PlyType::int8));
}

}  // namespace
}  // namespace keyline::exchange::detail
