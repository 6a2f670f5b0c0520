#include "postproc/html.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>

#include "postproc/output_file.h"

namespace lamella {
namespace {

constexpr const char* kStyle = R"(
:root { color-scheme: light; }
body { margin: 0; background: #f4f5f7; color: #20242b; font: 16px/1.55 system-ui, "DejaVu Sans", sans-serif; }
main { max-width: 1080px; margin: 0 auto; padding: 2.2rem 1.4rem 4rem; }
h1 { font-size: 1.9rem; margin: 0 0 .2rem; letter-spacing: -.01em; }
h2 { font-size: 1.2rem; margin: 2.2rem 0 .7rem; }
.quiet { color: #69707c; margin: 0; }
figure { background: #fff; border: 1px solid #e2e5ea; border-radius: 10px; margin: 1rem 0; padding: 1rem; }
figure img { display: block; max-width: 100%; height: auto; margin: 0 auto; }
figcaption { color: #4b525e; font-size: .92rem; margin-top: .7rem; }
.pair { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(420px, 100%), 1fr)); gap: 1rem; }
.pair figure { margin: 0; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(165px, 1fr)); gap: .8rem; margin: 1.4rem 0; }
.tile { background: #fff; border: 1px solid #e2e5ea; border-radius: 10px; padding: .7rem .95rem; }
.tile b { display: block; font-size: 1.3rem; font-weight: 600; }
.tile span { color: #69707c; font-size: .85rem; }
table { border-collapse: collapse; width: 100%; background: #fff; border: 1px solid #e2e5ea; font-size: .92rem; }
td, th { text-align: left; padding: .42rem .75rem; border-top: 1px solid #eceef2; vertical-align: top; }
td.number { white-space: nowrap; font-variant-numeric: tabular-nums; font-weight: 600; }
td.what { color: #59606c; }
pre { background: #fff; border: 1px solid #e2e5ea; border-radius: 10px; padding: 1rem; overflow-x: auto; font-size: .84rem; line-height: 1.45; }
.warning { background: #fff4e2; border: 1px solid #f0cf95; border-radius: 10px; padding: .6rem 1rem; margin: .8rem 0; }
)";

std::string base64(const std::string& bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    const std::size_t left = std::min<std::size_t>(3, bytes.size() - k);
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j) group = group << 8 | (j < left ? static_cast<unsigned char>(bytes[k + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j) out += j <= left ? kDigits[group >> (18 - 6 * j) & 63] : '=';
  }
  return out;
}

}  // namespace

std::string html_escaped(const std::string& text) {
  std::string out;
  for (char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string title_of(std::string key) {
  for (char& c : key)
    if (c == '_') c = ' ';
  if (!key.empty()) key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  return key;
}

std::string html_figure(const ReportPicture& picture) {
  return fmt::format("<figure><img alt=\"{}\" src=\"data:image/png;base64,{}\"><figcaption>{}</figcaption></figure>\n",
                     html_escaped(picture.caption), base64(read_binary_file(picture.png)),
                     html_escaped(picture.caption));
}

std::string html_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, "
      "initial-scale=1\">\n<title>{0}</title>\n<style>{1}</style>\n</head>\n<body><main>\n<h1>{0}</h1>\n{2}"
      "</main></body>\n</html>\n",
      html_escaped(title), kStyle, body);
}

}  // namespace lamella
