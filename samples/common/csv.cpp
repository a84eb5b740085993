// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "csv.hpp"
#include "options.hpp"
#include "files.hpp"

#include "opencv2/core/cvstd.hpp"
#include <algorithm>
#include <iterator>

namespace rsackermann_samples {

namespace {

std::string trimmed(const std::string& text)
{
    const size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
    return first == std::string::npos ? std::string() : text.substr(first, last - first + 1);
}

// Takes rows from a text one by one.
class CsvReader
{
public:
    CsvReader(const std::string& text, const std::string& name) : text_(text), name_(name), at_(0), line_(1) {}

    // The next row that isn't empty and the line on which it begins; false at the end.
    bool next(std::vector<std::string>& cells, int& line)
    {
        while (at_ < text_.size() && isLineEnd(text_[at_]))
            skipLineEnd();
        if (at_ >= text_.size())
            return false;
        line = line_;
        cells.assign(1, cell());
        while (at_ < text_.size() && text_[at_] == ',')
        {
            at_++;
            cells.push_back(cell());
        }
        skipLineEnd();
        return true;
    }

private:
    static bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

    void skipLineEnd()
    {
        if (at_ < text_.size() && text_[at_] == '\r')
            at_++;
        if (at_ < text_.size() && text_[at_] == '\n')
            at_++;
        line_++;
    }

    // Up to the comma or the end of the line, which stay.
    std::string cell()
    {
        const size_t first = text_.find_first_not_of(" \t", at_);
        if (first != std::string::npos && text_[first] == '"')
        {
            at_ = first + 1;
            return quotedCell();
        }
        const size_t begin = at_;
        while (at_ < text_.size() && text_[at_] != ',' && !isLineEnd(text_[at_]))
            at_++;
        return trimmed(text_.substr(begin, at_ - begin));
    }

    std::string quotedCell()
    {
        const int begin = line_;
        std::string result;
        for (; at_ < text_.size(); at_++)
        {
            if (text_[at_] == '"' && (at_ + 1 == text_.size() || text_[at_ + 1] != '"'))
            {
                at_ = std::min(text_.find_first_not_of(" \t", at_ + 1), text_.size());
                if (at_ < text_.size() && text_[at_] != ',' && !isLineEnd(text_[at_]))
                    throw UsageError(
                        cv::format("line %d of %s: there is something behind a closing quote", line_, name_.c_str()));
                return result;
            }
            at_ += text_[at_] == '"';
            line_ += text_[at_] == '\n';
            result += text_[at_];
        }
        throw UsageError(cv::format("line %d of %s: a quote isn't closed", begin, name_.c_str()));
    }

    const std::string &text_, &name_;
    size_t at_;
    int line_;
};

} // namespace

// Which of two columns of one name is meant nobody knows; several may have none.
static void checkNames(const std::vector<std::string>& header, const std::string& path)
{
    for (size_t i = 0; i < header.size(); i++)
        if (!header[i].empty() && std::count(header.begin(), header.begin() + std::ptrdiff_t(i), header[i]))
            throw UsageError(
                cv::format("column %d of %s: '%s' is there twice", int(i + 1), path.c_str(), header[i].c_str()));
}

size_t CsvTable::find(const std::string& name) const
{
    return size_t(std::find(header.begin(), header.end(), name) - header.begin());
}

std::vector<size_t> CsvTable::columns(const std::vector<std::string>& names) const
{
    std::vector<size_t> found;
    std::string words;
    for (size_t i = 0; i < names.size(); i++)
    {
        found.push_back(find(names[i]));
        words += (i == 0 ? "" : i + 1 < names.size() ? ", " : " and ") + names[i];
    }
    if (std::count(found.begin(), found.end(), header.size()) > 0)
        throw UsageError(path + ": a header with " + words + " is needed");
    return found;
}

std::string CsvTable::placeOf(size_t row, const std::string& column) const
{
    return cv::format("line %d of %s, column %s", lines[row], path.c_str(), column.c_str());
}

double CsvTable::number(size_t row, size_t column) const
{
    return parseNumber(rows[row][column], placeOf(row, header[column]));
}

void CsvTable::beginAt(size_t row)
{
    header = rows[row];
    checkNames(header, path);
    rows.erase(rows.begin(), rows.begin() + std::ptrdiff_t(row + 1));
    lines.erase(lines.begin(), lines.begin() + std::ptrdiff_t(row + 1));
    for (size_t i = 0; i < rows.size(); i++)
        if (rows[i].size() != header.size())
            throw UsageError(cv::format("line %d of %s: there are %d cells, but %d columns", lines[i], path.c_str(),
                                        int(rows[i].size()), int(header.size())));
}

CsvTable readCsv(const std::string& path)
{
    return readCsv(path, [](const std::vector<std::string>&) { return false; });
}

CsvTable readCsv(const std::string& path, bool (*isRagged)(const std::vector<std::string>& header))
{
    std::ifstream file = openText(path);
    if (!file)
        throw UsageError(path + " can't be read");
    const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    if (text.find('\0') != std::string::npos)
        throw UsageError(path + " has a zero byte: it isn't a text");
    CsvReader reader(text, path);
    CsvTable table;
    table.path = path;
    int line = 0;
    for (std::vector<std::string> cells; reader.next(cells, line);)
    {
        table.rows.push_back(cells);
        table.lines.push_back(line);
    }
    if (table.rows.empty())
        throw UsageError(path + " is empty");
    if (isRagged(table.rows[0]))
        table.header = table.rows[0];
    else
        table.beginAt(0);
    return table;
}

} // namespace rsackermann_samples
