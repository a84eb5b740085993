// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_EXPORT_POINT_TABLE_HPP
#define RSACKERMANN_SAMPLES_EXPORT_POINT_TABLE_HPP

#include "csv.hpp"
#include "frames.hpp"

namespace rsackermann_samples {

/** A CSV table with a point in each row, which belongs to the frame that the column file names; with one frame the
column may be missing. */
class PointTable
{
public:
    //! Throws UsageError with the line that isn't understood, or if a column that is needed is missing.
    PointTable(const std::string& path, const std::vector<std::string>& needed, const std::vector<MotionFrame>& frames);

    //! The rows of the points of a frame.
    const std::vector<size_t>& rowsOf(size_t frame) const { return rows_[frame]; }
    //! A column; as many as there are if none has the name.
    size_t column(const std::string& name) const { return table_.find(name); }
    //! A number; 0 if its cell is empty or there is no such column. Throws UsageError with the line.
    double number(size_t row, size_t column) const;
    //! The same of a cell that must not be empty.
    double numberThere(size_t row, size_t column) const { return table_.number(row, column); }
    //! Adds a column of empty cells; throws UsageError if there is one of this name.
    size_t addColumn(const std::string& name);
    void set(size_t row, size_t column, const std::string& cell) { table_.rows[row][column] = cell; }
    //! The table as a file has it.
    std::string text() const;

private:
    CsvTable table_;
    std::vector<std::vector<size_t>> rows_; // by frame
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_EXPORT_POINT_TABLE_HPP
