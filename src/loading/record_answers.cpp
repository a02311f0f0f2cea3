#include "record_answers.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include "answer_lines.h"
#include "base/number_text.h"
#include "base/short_text.h"
#include "concave_distance/base/error.h"
#include "kinematics/wording.h"
#include "scene/replay_pair.h"

namespace concave_distance::detail {
namespace {

constexpr std::ptrdiff_t kMostColumns = 200;
constexpr std::streamoff kMostText = 64'000'000;  // bytes of niches, after which no pose is answered

/// One table, its rows as texts that lie in it: a file of tiny cells would take gigabytes as cells.
struct Table {
  struct Row {
    std::size_t line;  ///< of the file, from 1
    std::size_t index;
    std::string_view text;
  };
  std::vector<std::string_view> columns;
  std::vector<Row> rows;
};

std::vector<std::string_view> cellsOf(std::string_view line) {
  std::vector<std::string_view> cells;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    cells.push_back(line.substr(0, comma));
    line.remove_prefix(comma == std::string_view::npos ? line.size() : comma + 1);
  }
  return cells;
}

bool isOfWords(std::string_view column) {
  return column == "status" || column == "kind" || column == "outward" || column == "origin";
}

// Prominences may be infinite; what was not computed is empty.
bool isNumberCell(std::string_view cell) {
  if (cell.empty()) return true;
  const std::optional<double> value = parseNumber(cell);
  return value && !std::isnan(*value);
}

[[noreturn]] void failDamaged(const std::string& where, const std::string& what) {
  throw Error(where, what, "the recording is damaged: ask for it once more, or mend the file");
}

std::vector<std::string_view> requireCells(const Table& table, std::string_view line,
                                           const std::string& where) {
  const auto count = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
  if (count != table.columns.size()) {
    failDamaged(where,
                "it has " + std::to_string(count) + " cells of " + std::to_string(table.columns.size()));
  }
  std::vector<std::string_view> cells = cellsOf(line);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (isOfWords(table.columns[i]) || isNumberCell(cells[i])) continue;
    failDamaged(where, "column " + shortText(std::string(table.columns[i])) + " is '" +
                           shortText(std::string(cells[i])) + "'");
  }
  return cells;
}

std::size_t indexOf(std::string_view cell, std::size_t poses, const std::string& where) {
  const std::optional<double> index = parseNumber(cell);
  if (!index || !(*index >= 0.0) || !(*index < static_cast<double>(poses)) || *index != std::floor(*index))
    failDamaged(where, "column index is '" + shortText(std::string(cell)) + "', of " + std::to_string(poses) +
                           " poses");
  return static_cast<std::size_t>(*index);
}

/// @param rows that there have to be, as `why` says
Table tableOf(std::string_view text, const std::string& path, std::size_t poses, std::size_t rows,
              const std::string& why) {
  Table table;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::string where = path + ":" + std::to_string(number);
    const std::size_t end = text.find('\n');
    if (end == std::string_view::npos) failDamaged(where, "the file ends in the middle of this line");
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (number == 1) {
      if (std::count(line.begin(), line.end(), ',') > kMostColumns)
        failDamaged(where, "the columns are not those of a recording");
      table.columns = cellsOf(line);
      continue;
    }
    const Table::Row row{number, indexOf(requireCells(table, line, where).front(), poses, where), line};
    if (!table.rows.empty() && row.index < table.rows.back().index)
      failDamaged(where, "index " + std::to_string(row.index) + " comes after " +
                             std::to_string(table.rows.back().index));
    if (table.rows.size() == rows)
      failDamaged(where,
                  "there are more lines below the header than " + std::to_string(rows) + ", as " + why);
    table.rows.push_back(row);
  }
  if (table.rows.size() != rows)
    failDamaged(path, "it has " + counted(table.rows.size(), "line") + " below its header, " + why + " " +
                          std::to_string(rows));
  return table;
}

std::string pathIn(const std::string& folder, const char* file) {
  return (std::filesystem::path(folder) / file).string();
}

struct Tables {
  Table answers;
  Table niches;
};

Tables tablesOf(const std::string& folder, const RecordAnswers& texts) {
  Tables tables;
  const std::string answers = pathIn(folder, kRecordAnswers);
  tables.answers =
      tableOf(texts.answers, answers, texts.count, texts.count, std::string(kRecordFile) + " says");
  for (std::size_t i = 1; i < tables.answers.rows.size(); ++i) {
    const Table::Row& row = tables.answers.rows[i];
    if (row.index != i)
      failDamaged(answers + ":" + std::to_string(row.line),
                  "two lines have the index " + std::to_string(row.index));
  }
  if (texts.niches.empty()) return tables;
  const std::string niches = pathIn(folder, kRecordNiches);
  const auto& columns = tables.answers.columns;
  const auto column =
      static_cast<std::size_t>(std::find(columns.begin(), columns.end(), "niche_count") - columns.begin());
  double count = 0.0;
  for (const Table::Row& row : tables.answers.rows)
    count += column < columns.size() ? parseNumber(cellsOf(row.text)[column]).value_or(0.0) : 0.0;
  tables.niches =
      tableOf(texts.niches, niches, texts.count, static_cast<std::size_t>(std::clamp(count, 0.0, 1e15)),
              std::string(kRecordAnswers) + " counts");
  return tables;
}

void requireColumns(const Table& recorded, const Table& now, const std::string& path) {
  const std::size_t common = std::min(recorded.columns.size(), now.columns.size());
  if (common > 0 && std::equal(now.columns.begin(), now.columns.begin() + static_cast<std::ptrdiff_t>(common),
                               recorded.columns.begin()))
    return;
  failDamaged(path + ":1", "the columns are not those of a recording");
}

class Comparison {
 public:
  Comparison(const Table& recorded, const Table& now, const std::string& path)
      : recorded_(recorded), now_(now), path_(path) {
    difference_.rows = recorded.rows.size();
  }

  TableDifference run() {
    std::size_t r = 0;
    std::size_t n = 0;
    while (r < recorded_.rows.size() || n < now_.rows.size()) {
      const std::size_t index = std::min(indexAt(recorded_, r), indexAt(now_, n));
      const std::size_t r_end = endOf(recorded_, r, index);
      const std::size_t n_end = endOf(now_, n, index);
      compareGroup(index, r, r_end, n, n_end);
      r = r_end;
      n = n_end;
    }
    return std::move(difference_);
  }

 private:
  static std::size_t indexAt(const Table& table, std::size_t row) {
    return row < table.rows.size() ? table.rows[row].index : static_cast<std::size_t>(-1);
  }
  static std::size_t endOf(const Table& table, std::size_t row, std::size_t index) {
    while (row < table.rows.size() && table.rows[row].index == index) ++row;
    return row;
  }

  void compareGroup(std::size_t index, std::size_t r, std::size_t r_end, std::size_t n, std::size_t n_end) {
    if (r_end - r != n_end - n) {
      const std::size_t line = r < recorded_.rows.size() ? recorded_.rows[r].line : recorded_.rows.size() + 1;
      note(path_ + ":" + std::to_string(line) + ": pose " + std::to_string(index) + " has " +
           counted(n_end - n, "line") + ", recorded: " + std::to_string(r_end - r));
      difference_.other_rows += std::max(r_end - r, n_end - n);
      return;
    }
    for (; r < r_end; ++r, ++n) compareRow(recorded_.rows[r], now_.rows[n]);
  }

  void compareRow(const Table::Row& recorded, const Table::Row& now) {
    bool is_same = true;
    const std::vector<std::string_view> before = cellsOf(recorded.text);
    const std::vector<std::string_view> after = cellsOf(now.text);
    for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) {
      if (before[i] == after[i]) continue;
      is_same = false;
      const std::string column(recorded_.columns[i]);
      const std::string where = path_ + ":" + std::to_string(recorded.line) + ": " + column;
      note(where + " is " + shown(after[i]) + ", recorded: " + shown(before[i]));
      if (isOfWords(column)) continue;
      const double gap = std::abs(parseNumber(after[i]).value_or(std::nan("")) -
                                  parseNumber(before[i]).value_or(std::nan("")));
      if (!(gap > difference_.largest)) continue;
      difference_.largest = gap;
      difference_.largest_where = where;
    }
    if (!is_same) ++difference_.other_rows;
  }

  static std::string shown(std::string_view cell) { return cell.empty() ? "empty" : std::string(cell); }
  void note(const std::string& what) {
    if (difference_.first.empty()) difference_.first = what;
  }

  const Table& recorded_;
  const Table& now_;
  const std::string& path_;
  TableDifference difference_;
};

}  // namespace

RecordAnswers answersTo(const PairRecord& record, WorkLimit::Clock::time_point end,
                        const std::atomic<bool>* stop) {
  TextStream answers;
  TextStream niches;
  CsvWriter answer_line(answers);
  CsvWriter niche_line(niches);
  const TrackerParameters tracker =
      withMargins(record.pair->settings.tracker, *record.body_a, *record.body_b);
  const bool has_margins = tracker.margin() > 0.0;
  answers << answerColumns(has_margins) << '\n';
  niches << nicheColumns(has_margins) << '\n';
  const auto write = [&](std::size_t index, const TrackedPair& pair) {
    QueryAnswer answer = answerOf(pair.solution, pair.solved() && record.with_niches);
    if (!pair.solved()) {
      answer.status = kBeyondCutoff;
      answer.lower_bound = pair.box_bound.value_or(kNotComputed);
    }
    writeAnswer(index, answer, has_margins, answer_line);
    if (!answer.niche_count) return true;
    for (const TrackedNiche& niche : pair.solution.niches) {
      writeNiche(index, niche.id, niche, tracker.accuracy != AccuracyLevel::Nodes, has_margins, niche_line);
    }
    return niches.tellp() < std::streampos(kMostText);
  };
  RecordAnswers result;
  result.count = replayPair(*record.pair, record.body_a, record.body_b, record.poses, record.with_niches, end,
                            stop, write);
  result.answers = answers.str();
  if (record.with_niches) result.niches = niches.str();
  return result;
}

void requireWhole(const std::string& folder, const RecordAnswers& recorded) {
  tablesOf(folder, recorded);
}

RecordDifference compareAnswers(const std::string& folder, const RecordAnswers& recorded,
                                const RecordAnswers& now) {
  const Tables before = tablesOf(folder, recorded);
  const Tables after = tablesOf(folder, now);
  RecordDifference difference;
  const std::string answers = pathIn(folder, kRecordAnswers);
  requireColumns(before.answers, after.answers, answers);
  difference.answers = Comparison(before.answers, after.answers, answers).run();
  if (recorded.niches.empty()) return difference;
  const std::string niches = pathIn(folder, kRecordNiches);
  requireColumns(before.niches, after.niches, niches);
  difference.niches = Comparison(before.niches, after.niches, niches).run();
  return difference;
}

}  // namespace concave_distance::detail
