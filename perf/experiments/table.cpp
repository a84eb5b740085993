// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#include "table.hpp"
#include "options.hpp"

#include <algorithm>
#include <fstream>

namespace experiments {

using rsackermann_samples::InputError;

// A line of comma-separated values; empty at the end. A value in quotes may have commas.
static std::vector<std::string> readFields(std::istream& file)
{
    std::string line;
    std::getline(file, line);
    if (!line.empty() && line.back() == '\r')
        line.pop_back();
    std::vector<std::string> fields;
    bool quoted = false;
    for (size_t i = 0; i < line.size(); i++)
    {
        if (i == 0 || (line[i] == ',' && !quoted))
            fields.push_back("");
        if (line[i] == '"')
            quoted = !quoted;
        else if (line[i] != ',' || quoted)
            fields.back() += line[i];
    }
    return fields;
}

std::vector<std::vector<std::string>> readTable(const std::string& file, const std::vector<std::string>& columns)
{
    std::ifstream stream(file.c_str());
    const std::vector<std::string> names = readFields(stream);
    std::vector<size_t> places;
    for (const std::string& column : columns)
    {
        places.push_back(std::find(names.begin(), names.end(), column) - names.begin());
        if (places.back() == names.size())
            throw InputError(file + " can't be read or has no column " + column);
    }
    std::vector<std::vector<std::string>> rows;
    for (std::vector<std::string> fields = readFields(stream); !fields.empty(); fields = readFields(stream))
    {
        if (fields.size() != names.size())
            throw InputError(file + ": a line has another number of columns than the first");
        std::vector<std::string> row;
        for (size_t place : places)
            row.push_back(fields[place]);
        rows.push_back(row);
    }
    return rows;
}

} // namespace experiments
