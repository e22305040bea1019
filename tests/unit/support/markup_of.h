#pragma once
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <string>
#include <vector>

namespace rsphere {

// A page or a plot, read as XML. The test fails if it is not well-formed.
inline pugi::xml_document parsed(const std::string& markup) {
  pugi::xml_document document;
  const pugi::xml_parse_result result = document.load_buffer(
      markup.data(), markup.size(), pugi::parse_default | pugi::parse_doctype | pugi::parse_ws_pcdata);
  EXPECT_TRUE(result) << result.description() << " at " << markup.substr(size_t(result.offset), 80);
  return document;
}

// The text of the elements that an XPath expression finds, with that of the elements in them.
inline std::vector<std::string> texts(const pugi::xml_document& document, const char* path) {
  std::vector<std::string> found;
  for (const pugi::xpath_node& node : document.select_nodes(path))
    found.push_back(pugi::xpath_query("string(.)").evaluate_string(node));
  return found;
}

// That nothing in the page asks for another file, and that it has no script.
inline void expectSelfContained(const pugi::xml_document& page) {
  for (const pugi::xpath_node& node : page.select_nodes("//@src|//@href|//@*[name()='xlink:href']"))
    EXPECT_EQ(std::string(node.attribute().value()).rfind("data:", 0), 0u) << node.attribute().value();
  EXPECT_TRUE(page.select_nodes("//script|//link|//iframe|//object|//embed").empty());
  for (const std::string& style : texts(page, "//style")) {
    EXPECT_EQ(style.find("url("), std::string::npos);
    EXPECT_EQ(style.find("@import"), std::string::npos);
  }
}

}  // namespace rsphere
