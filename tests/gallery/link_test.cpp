#include "gallery/page.hpp"

#include <gtest/gtest.h>

namespace lobelia::gallery {
namespace {

TEST(Links, are_percent_encoded_part_by_part) {
  EXPECT_EQ(link_to({"cells", "a b", "index.html"}), "cells/a%20b/index.html");
  EXPECT_EQ(link_to({"javascript:x"}), "javascript%3Ax");
  EXPECT_EQ(link_to({"50%#?\"<"}), "50%25%23%3F%22%3C");
  EXPECT_EQ(link_to({"ü"}), "%C3%BC");
}

}  // namespace
}  // namespace lobelia::gallery
