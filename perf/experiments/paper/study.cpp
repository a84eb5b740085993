// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "study.hpp"
#include "options.hpp"

#include "opencv2/core.hpp"
#include "opencv2/core/utility.hpp"
#include <cstdio>
#include <fstream>

namespace paper {

void writeTable(const std::string& file, const std::string& header, const std::vector<Row>& rows)
{
    const std::string part = file + ".part";
    {
        std::ofstream stream(part.c_str());
        stream << header << '\n';
        for (const Row& row : rows)
            for (size_t i = 0; i < row.size(); i++)
                stream << row[i] << (i + 1 < row.size() ? ',' : '\n');
        if (!stream.flush())
            throw rsackermann_samples::InputError(part + " can't be written");
    }
    if (std::rename(part.c_str(), file.c_str()) != 0)
        throw rsackermann_samples::InputError(file + " can't be written");
}

std::string number(double value, int decimals)
{
    return cv::format("%.*f", decimals, value);
}

std::vector<std::vector<Row>> makeRows(const std::string& title, int items, int tables,
                                       const std::function<void(int, std::vector<std::vector<Row>>&)>& make)
{
    std::vector<std::vector<std::vector<Row>>> made(items, std::vector<std::vector<Row>>(tables));
    cv::Mutex mutex;
    int done = 0;
    cv::parallel_for_(
        cv::Range(0, items),
        [&](const cv::Range& range) {
            for (int i = range.start; i < range.end; i++)
            {
                make(i, made[i]);
                cv::AutoLock lock(mutex);
                done++;
                if (done * 20 / items != (done - 1) * 20 / items)
                    std::fprintf(stderr, "%s: %d of %d\n", title.c_str(), done, items);
            }
        },
        items);
    std::vector<std::vector<Row>> rows(tables);
    for (const std::vector<std::vector<Row>>& item : made)
        for (int k = 0; k < tables; k++)
            rows[k].insert(rows[k].end(), item[k].begin(), item[k].end());
    return rows;
}

} // namespace paper
