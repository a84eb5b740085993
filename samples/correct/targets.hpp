// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_TARGETS_HPP
#define RSACKERMANN_SAMPLES_TARGETS_HPP

#include "job.hpp"
#include "output/output_plan.hpp"

namespace rsackermann_samples {

//! Where the results for an input go; empty if they aren't wanted.
struct Targets
{
    std::string output, overlay, maps; //!< maps of a video: the beginning of the names for its frames

    Targets(const Job& job, const std::string& input);

    //! The file for the maps of a video's frame.
    std::string mapsOfFrame(int frame) const;
    //! Leaves out the results that are there already; throws InputError if the frames of a video can't be counted.
    void leaveOutExisting();
    bool empty() const { return output.empty() && overlay.empty() && maps.empty(); }
    //! Throws InputError if a result would replace a file that mustn't be replaced.
    void check(const Job& job) const;
    //! Tells a plan of the results; throws UsageError.
    void addTo(OutputPlan& plan) const;

private:
    bool hasMapsOfAllFrames() const;

    std::string input_;
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_TARGETS_HPP
