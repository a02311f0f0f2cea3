#pragma once

#include <algorithm>
#include <string>

namespace concave_distance::tools {

/// `--time-budget` of `time_budget`.
inline std::string optionName(std::string parameter) {
  std::replace(parameter.begin(), parameter.end(), '_', '-');
  return "--" + parameter;
}

/// A sentence of a parameter table without Markdown: of links their texts, and no backquotes.
inline std::string withoutMarkdown(const std::string& sentence) {
  std::string text;
  for (std::size_t i = 0; i < sentence.size(); ++i) {
    if (sentence[i] == '`') continue;
    const std::size_t end = sentence[i] == '[' ? sentence.find(']', i) : std::string::npos;
    if (end == std::string::npos || sentence.compare(end, 2, "](") != 0) {
      text += sentence[i];
      continue;
    }
    text.append(sentence, i + 1, end - i - 1);
    i = std::min(sentence.find(')', end), sentence.size() - 1);
  }
  return text;
}

}  // namespace concave_distance::tools
