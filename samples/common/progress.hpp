// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_PROGRESS_HPP
#define RSACKERMANN_SAMPLES_PROGRESS_HPP

#include "opencv2/core.hpp"
#include <string>

namespace rsackermann_samples {

/** One line on standard error that says how far a program is and how long it will take; only if standard error is a
terminal, and not in the first second. */
class Progress
{
public:
    Progress();
    //! Removes the line.
    ~Progress() { clear(); }

    /** Rewrites the line, at most some times in a second.
    @param done the work that is done.
    @param total all of the work, in the same unit.
    @param what the name of the work. */
    void update(double done, double total, const std::string& what);

    //! Removes the line, so that a message can be written; it comes back with the next update.
    void clear();

private:
    Progress(const Progress&);
    Progress& operator=(const Progress&);

    const bool isTerminal_;
    const int64 start_;
    int64 shown_; // when the line was written last
    bool visible_;
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_PROGRESS_HPP
