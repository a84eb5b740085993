// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_PERF_STUDY_HPP
#define RSACKERMANN_PERF_STUDY_HPP

#include <functional>
#include <string>
#include <vector>

namespace paper {

//! How a study is made.
struct StudyOptions
{
    std::string folder; //!< for its files
    std::string photos; //!< folder with photographs, frames or drives; empty: none
    bool quick;         //!< a part of the cases
    int seed;
};

typedef std::vector<std::string> Row;

//! A file of comma-separated values that appears when it is complete.
void writeTable(const std::string& file, const std::string& header, const std::vector<Row>& rows);

//! A number with a given number of decimals.
std::string number(double value, int decimals = 4);

/** Makes the rows of all items in parallel, in the order of the items, with progress on the error output.
@param make rows of an item; each item's rows go to several tables. */
std::vector<std::vector<Row>> makeRows(const std::string& title, int items, int tables,
                                       const std::function<void(int, std::vector<std::vector<Row>>&)>& make);

// The studies. Each writes the tables of its name and what else the comment says.
void studyMotion(const StudyOptions& options); // and displacement
void studyPatches(const StudyOptions& options);
void studyGravity(const StudyOptions& options);
void studyDistances(const StudyOptions& options);
void studyTime(const StudyOptions& options);
void studySolvers(const StudyOptions& options); // and solver_condition
void studySolverTime(const StudyOptions& options);
void studyBound(const StudyOptions& options);
void studyConditions(const StudyOptions& options);
void studyPhotos(const StudyOptions& options); // and strips

} // namespace paper

#endif // RSACKERMANN_PERF_STUDY_HPP
