// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef RSACKERMANN_SAMPLES_OUTPUT_PLAN_HPP
#define RSACKERMANN_SAMPLES_OUTPUT_PLAN_HPP

#include <map>
#include <set>
#include <string>

namespace rsackermann_samples {

/** All files that a program is going to write, so that conflicts are found before any work is done.

Names that lead to the same file are the same, however they are written: with ./ or .., through links, or in another
case if the file system makes no difference.
*/
class OutputPlan
{
public:
    //! Adds a file that is read and mustn't be replaced; before the results.
    void addInput(const std::string& path);
    template <class Paths>
    void addInputs(const Paths& paths)
    {
        for (const std::string& path : paths)
            addInput(path);
    }
    /** Tells of a file that is to be written.
    @param source whose result it is, for the message. Throws UsageError if it is an input or the result of another
    source. */
    void addOutput(const std::string& path, const std::string& source);
    //! Tells of files STEM_NNNNNN with an extension, for each frame of a video; before the outputs that may have such a
    //! name.
    void addFrames(const std::string& stem, const std::string& extension, const std::string& source);
    //! Removes the files that killed programs have left in the folders of the outputs.
    void removeLeftovers() const;

private:
    struct Place
    {
        std::string folder, name;
    };

    Place placeOf(const std::string& path);
    struct Output
    {
        std::string name, source;
    };

    void add(const Place& place, const std::string& path, const std::string& source);

    std::map<std::string, std::string> inputs_;  // a file's unique key, and its name
    std::multimap<std::string, Output> outputs_; // by the name in lower case
    std::set<std::string> folders_, frames_;
};

} // namespace rsackermann_samples

#endif // RSACKERMANN_SAMPLES_OUTPUT_PLAN_HPP
