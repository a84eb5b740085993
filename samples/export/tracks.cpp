// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "tracks.hpp"
#include "csv.hpp"
#include "options.hpp"
#include "opencv2/rsackermann/warp.hpp"

#include <algorithm>
#include <map>

namespace rsackermann_samples {

using namespace cv::rsackermann;

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
struct FramePoints
{
    std::vector<cv::Point2d> points;
    std::vector<double> depths;
    std::vector<size_t> rows; // of the table
};

struct Columns
{
    size_t file, x, y, depth; // as many as there are columns: none has this name

    explicit Columns(const Cells& header)
        : file(of("file", header)), x(of("x", header)), y(of("y", header)), depth(of("depth", header))
    {
    }

    static size_t of(const char* name, const Cells& header)
    {
        return std::find(header.begin(), header.end(), name) - header.begin();
    }
};

// The indices of frames by their paths and names; a name that different inputs share has none.
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

std::vector<FramePoints> pointsOf(const CsvTable& table, const std::string& path, const Columns& columns,
                                  const std::vector<MotionFrame>& frames)
{
    const size_t none = table.header.size();
    if (columns.x == none || columns.y == none || (columns.file == none && frames.size() != 1))
        throw UsageError(path + ": a header with x, y" + (frames.size() == 1 ? "" : " and file") + " is needed");
    const FrameNames names(frames);
    std::vector<FramePoints> points(frames.size());
    for (size_t i = 0; i < table.rows.size(); i++)
    {
        const Cells& row = table.rows[i];
        const std::string source = path + cv::format(", line %d", table.lines[i]);
        FramePoints& frame = points[columns.file == none ? 0 : names.of(row[columns.file], source)];
        frame.points.push_back(cv::Point2d(parseNumber(row[columns.x], source), parseNumber(row[columns.y], source)));
        frame.depths.push_back(
            columns.depth == none || row[columns.depth].empty() ? 0 : parseNumber(row[columns.depth], source));
        frame.rows.push_back(i);
    }
    return points;
}

} // namespace

std::string correctTracks(const std::string& path, const RollingShutterCamera& camera,
                          const std::vector<MotionFrame>& frames)
{
    CsvTable table = readCsv(path);
    const Columns columns(table.header);
    const std::vector<FramePoints> points = pointsOf(table, path, columns, frames);
    const cv::Ptr<WarpMapGenerator> generator = WarpMapGenerator::create(camera);
    for (size_t i = 0; i < frames.size(); i++)
    {
        const FramePoints& frame = points[i];
        if (frame.points.empty())
            continue;
        generator->setCamera(frames[i].cameraOf(camera));
        const bool depthsKnown = cv::countNonZero(frame.depths) > 0;
        cv::Mat places, mask;
        generator->correctPoints(frames[i].motion, frame.points, places,
                                 depthsKnown ? cv::Mat(frame.depths) : cv::Mat(), mask);
        for (size_t k = 0; k < frame.rows.size(); k++)
        {
            Cells& row = table.rows[frame.rows[k]];
            const cv::Vec2d place = places.at<cv::Vec2d>(int(k));
            const bool found = mask.at<uchar>(int(k)) != 0;
            row[columns.x] = found ? cv::format("%.6f", place[0]) : "";
            row[columns.y] = found ? cv::format("%.6f", place[1]) : "";
        }
    }
    std::string text = lineOf(table.header);
    for (const Cells& row : table.rows)
        text += lineOf(row);
    return text;
}

} // namespace rsackermann_samples
