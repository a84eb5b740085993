// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_REPORT_FILE_HPP
#define RSACKERMANN_SAMPLES_REPORT_FILE_HPP

#include "job.hpp"
#include "output/shared_lines.hpp"
#include <set>

namespace rsackermann_samples {

/** The report: lines of JSON in a file, which other shards may write as well, or on standard output.

Lines of this job's inputs that are there already: with --overwrite they go; with --skip_existing complete ones stay,
and those of failures and of videos without all of their frames go. Lines of other inputs stay if this job is one of
several shards or goes on.
*/
class ReportFile
{
public:
    //! Throws InputError if the file can't be written or mustn't be replaced.
    explicit ReportFile(const Job& job);

    //! Whether the report has all lines of an input.
    bool has(const std::string& input) const;
    //! Adds the lines of an input; they are there when this returns. Throws InputError.
    void add(const std::vector<std::string>& lines);

private:
    void findComplete();
    void prepare(const Job& job);

    std::string path_; // empty: standard output
    SharedLines lines_;
    std::set<std::string> own_, complete_; // names in lines: this job's inputs, those that need nothing more
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_REPORT_FILE_HPP
