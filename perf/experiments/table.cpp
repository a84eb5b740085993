// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "table.hpp"
#include "options.hpp"

#include <fstream>
#include <sstream>

namespace experiments {

using rsackermann_samples::InputError;

// A line of comma-separated values; empty at the end.
static std::vector<std::string> readFields(std::istream& file)
{
    std::string line;
    std::getline(file, line);
    if (!line.empty() && line.back() == '\r')
        line.pop_back();
    std::vector<std::string> fields;
    std::istringstream stream(line);
    for (std::string field; std::getline(stream, field, ',');)
        fields.push_back(field);
    return fields;
}

std::vector<std::vector<std::string> > readTable(const std::string& file, const std::vector<std::string>& columns)
{
    std::ifstream stream(file.c_str());
    if (readFields(stream) != columns)
    {
        std::string expected;
        for (const std::string& column : columns)
            expected += (expected.empty() ? "" : ",") + column;
        throw InputError(file + " can't be read or has other columns than " + expected);
    }
    std::vector<std::vector<std::string> > rows;
    for (std::vector<std::string> fields = readFields(stream); !fields.empty(); fields = readFields(stream))
    {
        if (fields.size() != columns.size())
            throw InputError(file + ": a line has another number of columns than the first");
        rows.push_back(fields);
    }
    return rows;
}

} // namespace experiments
