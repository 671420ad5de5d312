#pragma once
// A report for people as one self-contained page: what it says, and its text. Nothing is loaded from anywhere
// and nothing runs: it opens from a mail or an archive, prints, and is read without colour or pictures.
#include <string>
#include <vector>

namespace blendwright {

/// Rows of text cells; the first row is the header. A column of figures stands to the right.
struct PageTable {
  std::string caption;
  std::vector<std::vector<std::string>> rows;
};

/// A picture (`png`: the file's bytes) or a plot (`svg`: its element).
struct PageFigure {
  std::string png, svg;
  std::string caption;
  std::string alternative;  ///< of a picture, for those who do not see it
};

struct PageSection {
  std::string title;
  std::vector<std::string> paragraphs{};
  std::vector<std::string> commands{};  ///< to be typed
  std::vector<PageTable> tables{};
  std::vector<PageFigure> figures{};
};

struct ReportPage {
  std::string title;
  enum class Verdict { good, bad, none } verdict = Verdict::none;
  std::string summary;  ///< the verdict in one sentence
  std::vector<PageSection> sections;
};

/// The page as XHTML-clean HTML 5: deterministic bytes, every text escaped.
[[nodiscard]] std::string html(const ReportPage& page);

/// RFC 4648, with padding.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace blendwright
