// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "point_table.hpp"
#include "options.hpp"

#include <map>

namespace rsackermann_samples {

namespace {

typedef std::vector<std::string> Cells;

std::string quoted(const std::string& cell)
{
    if (cell.find_first_of(",\"\r\n") == std::string::npos)
        return cell;
    std::string text = "\"";
    for (char c : cell)
        text += c == '"' ? "\"\"" : std::string(1, c);
    return text + "\"";
}

std::string lineOf(const Cells& cells)
{
    std::string line;
    for (size_t i = 0; i < cells.size(); i++)
        line += (i ? "," : "") + quoted(cells[i]);
    return line + "\n";
}

// The points of a frame, which are corrected together.
class FrameNames
{
public:
    explicit FrameNames(const std::vector<MotionFrame>& frames)
    {
        // Of a frame that a report has twice the last line counts.
        for (size_t i = 0; i < frames.size(); i++)
            byPath_[frames[i].path()] = i;
        for (const std::pair<const std::string, size_t>& entry : byPath_)
            byName_[frames[entry.second].name()].push_back(entry.first);
    }

    size_t of(const std::string& name, const std::string& source) const
    {
        const auto path = byPath_.find(name);
        if (path != byPath_.end())
            return path->second;
        const auto found = byName_.find(name);
        if (found == byName_.end())
            throw UsageError(source + ": there is no motion of the file " + name);
        const std::vector<std::string>& paths = found->second;
        if (paths.size() > 1)
            throw UsageError(source + ": the file " + name + " may be " + paths[0] + " or " + paths[1] +
                             "; name it with its folders");
        return byPath_.at(paths[0]);
    }

private:
    std::map<std::string, size_t> byPath_;
    std::map<std::string, std::vector<std::string>> byName_; // the paths
};

} // namespace

PointTable::PointTable(const std::string& path, const std::vector<std::string>& needed,
                       const std::vector<MotionFrame>& frames)
    : table_(readCsv(path)), rows_(frames.size())
{
    std::vector<std::string> all = needed;
    if (frames.size() != 1)
        all.push_back("file");
    table_.columns(all); // are there
    const FrameNames names(frames);
    const size_t file = column("file");
    for (size_t i = 0; i < table_.rows.size(); i++)
        rows_[file == table_.header.size() ? 0 : names.of(table_.rows[i][file], table_.placeOf(i, "file"))].push_back(
            i);
}

double PointTable::number(size_t row, size_t column) const
{
    return column == table_.header.size() || table_.rows[row][column].empty() ? 0 : table_.number(row, column);
}

size_t PointTable::addColumn(const std::string& name)
{
    if (column(name) != table_.header.size())
        throw UsageError(table_.path + ": there is a column " + name + " already");
    table_.header.push_back(name);
    for (Cells& row : table_.rows)
        row.push_back("");
    return table_.header.size() - 1;
}

std::string PointTable::text() const
{
    std::string text = lineOf(table_.header);
    for (const Cells& row : table_.rows)
        text += lineOf(row);
    return text;
}

} // namespace rsackermann_samples
