// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "depth_file.hpp"
#include "csv.hpp"
#include "options.hpp"

#include <cmath>

namespace rsackermann_samples {

cv::Mat readPointCloud(const std::string& path)
try
{
    const CsvTable table = readCsv(path);
    const std::vector<size_t> columns = table.columns({"x", "y", "z"});
    const size_t file = table.find("file");
    cv::Mat1d points(int(table.rows.size()), 3);
    for (size_t i = 0; i < table.rows.size(); i++)
    {
        const std::vector<std::string>& row = table.rows[i];
        if (file != table.header.size() && row[file] != table.rows[0][file])
            throw InputError(table.placeOf(i, "file") +
                             ": the points are of another file than those before; each image has its own table");
        for (size_t k = 0; k < 3; k++)
        {
            const std::string& cell = row[columns[k]];
            points(int(i), int(k)) = cell == "nan" || cell == "NaN" ? NAN // of organised clouds
                                                                    : table.number(i, columns[k]);
        }
    }
    return points;
}
catch (const UsageError& e) // of this image alone
{
    throw InputError(e.what());
}

} // namespace rsackermann_samples
