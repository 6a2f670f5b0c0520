// Pieces of the self-contained pages that are sent to a colleague: pictures inside, no links to anything.
#pragma once
#include <filesystem>
#include <string>

namespace lamella {

struct ReportPicture {
  std::filesystem::path png;
  std::string caption;
};

/// A page with the style that all reports share; `body` follows its heading.
std::string html_page(const std::string& title, const std::string& body);
/// The picture inside the page, its caption below.
std::string html_figure(const ReportPicture& picture);
std::string html_escaped(const std::string& text);
/// young_modulus -> Young modulus
std::string title_of(std::string key);

}  // namespace lamella
