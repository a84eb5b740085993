// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "point_cloud.hpp"
#include "csv.hpp"
#include "options.hpp"

#include <algorithm>
#include <cmath>

namespace rsackermann_samples {

cv::Mat readPointCloud(const std::string& path)
try
{
    const CsvTable table = readCsv(path);
    const auto column = [&table](const char* name) {
        return size_t(std::find(table.header.begin(), table.header.end(), name) - table.header.begin());
    };
    const size_t columns[] = {column("x"), column("y"), column("z")}, file = column("file"), none = table.header.size();
    if (std::count(columns, columns + 3, none) > 0)
        throw InputError(path + ": a header with x, y and z is needed");
    cv::Mat1d points(int(table.rows.size()), 3);
    for (int i = 0; i < points.rows; i++)
    {
        const std::string source = path + cv::format(", line %d", table.lines[i]);
        if (file != none && table.rows[i][file] != table.rows[0][file])
            throw InputError(source +
                             ": the points are of another file than those before; each image has its own table");
        for (int k = 0; k < 3; k++)
        {
            const std::string& cell = table.rows[i][columns[k]];
            points(i, k) = cell == "nan" || cell == "NaN" ? NAN : parseNumber(cell, source); // of organised clouds
        }
    }
    return points;
}
catch (const UsageError& e) // of this image alone
{
    throw InputError(e.what());
}

} // namespace rsackermann_samples
