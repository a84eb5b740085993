// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_CSV_HPP
#define RSACKERMANN_SAMPLES_CSV_HPP

#include <string>
#include <vector>

namespace rsackermann_samples {

//! A table of text with a header, as RFC 4180 describes it.
struct CsvTable
{
    std::string path;
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows; //!< each has as many cells as the header
    std::vector<int> lines;                     //!< the line of the file on which each row begins, from 1

    //! The column of this name; as many as there are if none has it.
    size_t find(const std::string& name) const;
    //! The columns of these names. Throws UsageError if one is missing.
    std::vector<size_t> columns(const std::vector<std::string>& names) const;
    //! Words for the place of a cell.
    std::string placeOf(size_t row, const std::string& column) const;
    //! The number in a cell; throws UsageError with the place if it is none.
    double number(size_t row, size_t column) const;
    //! Leaves the rows after one, which is their header; throws UsageError as readCsv().
    void beginAt(size_t row);
};

/** Reads a table: commas between, quotes around cells with commas, quotes or line ends. Lines without any character are
left out, and so are a byte order mark and blanks around cells. Throws UsageError with the line if a row hasn't as many
cells as the header or a quote isn't closed, and if two columns have one name. */
CsvTable readCsv(const std::string& path);

//! The same of a file whose rows may have any number of cells if its header is one of those.
CsvTable readCsv(const std::string& path, bool (*isRagged)(const std::vector<std::string>& header));

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_CSV_HPP
