#include "gallery/names.hpp"

#include <gtest/gtest.h>

namespace lobelia::gallery {
namespace {

TEST(Names, only_names_that_stay_where_they_are_are_plain) {
  for (const char* good : {"a", "phong_rdf-cosine_exact-n16", "a b", "c:d", "ü", "-x"}) {
    EXPECT_TRUE(is_plain_name(good)) << good;
  }
  for (const char* bad : {"", ".", "..", ".x", "a/b", "/a", "../a", "a\\b", "a\nb", "a\x7f"}) {
    EXPECT_FALSE(is_plain_name(bad)) << bad;
  }
  EXPECT_FALSE(is_plain_name(std::string("a\0b", 3)));
  EXPECT_FALSE(is_plain_name(std::string(201, 'a')));
}

TEST(Names, links_are_percent_encoded_part_by_part) {
  EXPECT_EQ(link_to({"cells", "a b", "index.html"}), "cells/a%20b/index.html");
  EXPECT_EQ(link_to({"javascript:x"}), "javascript%3Ax");
  EXPECT_EQ(link_to({"50%#?\"<"}), "50%25%23%3F%22%3C");
  EXPECT_EQ(link_to({"ü"}), "%C3%BC");
}

}  // namespace
}  // namespace lobelia::gallery
