// This file is part of OpenCV project.
// It is subject to the license terms in the LICENSE file found in the top-level directory
// of this distribution and at http://opencv.org/license.html.

#ifndef OPENCV_RSACKERMANN_SRC_STORAGE_HPP
#define OPENCV_RSACKERMANN_SRC_STORAGE_HPP

#include "checks.hpp"
#include "opencv2/rsackermann/camera.hpp"

namespace cv { namespace rsackermann {

//! Rows and columns that a file states of a matrix; -1 x -1 if it states none.
inline Size storedSize(const FileNode& matrix)
{
    Size stored(-1, -1);
    if (matrix.isMap())
    {
        cv::read(matrix["rows"], stored.height, -1);
        cv::read(matrix["cols"], stored.width, -1);
    }
    return stored;
}

inline void readFields(const FileNode&) {}

//! Reads values by their keys; one keeps its value if there is none.
template <class Value, class... Others>
void readFields(const FileNode& fn, const char* key, Value& value, Others&&... others)
{
    cv::read(fn[key], value, value);
    readFields(fn, others...);
}

/** Reads a matrix; it keeps its values if there is none. One of another size is refused before OpenCV takes the memory
for the size that the file states, whatever elements there are.
*/
template <int rows, int cols>
void readMatrix(const FileNode& fn, const char* key, Matx<double, rows, cols>& matrix)
{
    const FileNode node = fn[key];
    if (node.empty())
        return;
    const Size stored = storedSize(node);
    REJECT_IF(stored != Size(cols, rows), "%s is %d x %d; a matrix of %d x %d is expected", key, stored.height,
              stored.width, rows, cols);
    cv::read(node, matrix, matrix);
}

/** Storage of the algorithms, each made from a camera and parameters: the keys of the parameters and a map with the
camera.

@tparam Algorithm AckermannEstimator, WarpMapGenerator, RollingShutterCorrector or MountCalibrator.
*/
template <class Algorithm>
class StoredAlgorithm : public Algorithm
{
public:
    void write(FileStorage& fs) const CV_OVERRIDE
    {
        this->writeFormat(fs);
        fs.startWriteStruct("camera", FileNode::MAP);
        this->getCamera().write(fs);
        fs.endWriteStruct();
        this->getParams().write(fs);
        fs << "algorithm" << this->getDefaultName(); // last: a word that is cut short is another one
    }

    //! Sets both or, if one of them is bad, neither. Missing fields of a state that is written by hand keep their
    //! values.
    void read(const FileNode& fn) CV_OVERRIDE
    {
        checkState(fn, *this);
        RollingShutterCamera camera = this->getCamera();
        camera.read(fn["camera"]);
        camera.check();
        typename Algorithm::Params params = this->getParams();
        params.read(fn);
        params.check();
        if (!fn["camera"].empty())
            this->setCamera(camera);
        this->setParams(params);
    }

    static Ptr<Algorithm> load(const String& filename, const String& objname)
    {
        const FileStorage fs(filename, FileStorage::READ);
        REJECT_IF(!fs.isOpened(), "filename is \"%s\"; a file that save() has written is expected", filename.c_str());
        const FileNode fn = objname.empty() ? fs.getFirstTopLevelNode() : fs[objname];
        const Ptr<Algorithm> algorithm = Algorithm::create(RollingShutterCamera::fromFocal(Size(1, 1)));
        checkState(fn, *algorithm);
        REJECT_IF(
            !fn.isMap() || !fn["camera"].isMap(),
            "objname is \"%s\"; the name that save() has given an object in \"%s\", or an empty one for the first "
            "object, is expected",
            objname.c_str(), filename.c_str());
        RollingShutterCamera camera;
        camera.read(fn["camera"]);
        algorithm->setCamera(camera);
        typename Algorithm::Params params;
        params.read(fn);
        algorithm->setParams(params);
        return algorithm;
    }

private:
    // What another algorithm has stored, or a part of a state, would be one with default parameters.
    static void checkState(const FileNode& fn, const Algorithm& algorithm)
    {
        if (!fn.isMap())
            return;
        const FileNode stated = fn["algorithm"];
        const String expected = algorithm.getDefaultName(), stored = stated.isString() ? String(stated) : fn.name();
        // Other names of a node are of the user's choice.
        const bool isOfModule = stated.isString() || stored.compare(0, 12, "rsackermann_") == 0;
        REJECT_IF(isOfModule && stored != expected, "the file holds a %s; a %s is expected", stored.c_str(),
                  expected.c_str());
        if (fn["format"].empty()) // the first key of what write() has written
            return;
        FileStorage whole(".yml", FileStorage::WRITE | FileStorage::MEMORY);
        algorithm.write(whole);
        checkKeys(fn, FileStorage(whole.releaseAndGetString(), FileStorage::READ | FileStorage::MEMORY).root(), "");
    }

    static void checkKeys(const FileNode& stored, const FileNode& whole, const String& path)
    {
        for (const String& key : whole.keys())
        {
            const FileNode node = stored[key];
            const bool isNothing = node.isNone() && !whole[key].isSeq(); // an empty list is none in XML
            REJECT_IF(node.empty() || isNothing, "the file lacks %s%s; all that save() has written is expected",
                      path.c_str(), key.c_str());
            if (whole[key].isMap() && node.isMap())
                checkKeys(node, whole[key], path + key + ".");
        }
    }
};

//! One with nothing that would have to follow its camera and its parameters.
template <class Algorithm>
class StatelessAlgorithm : public StoredAlgorithm<Algorithm>
{
public:
    typedef typename Algorithm::Params Params;

    StatelessAlgorithm(const RollingShutterCamera& camera_, const Params& params_) : camera(camera_), params(params_)
    {
        camera_.check();
        params_.check();
    }

    void setCamera(const RollingShutterCamera& camera_) CV_OVERRIDE
    {
        camera_.check();
        camera = camera_;
    }

    RollingShutterCamera getCamera() const CV_OVERRIDE { return camera; }

    void setParams(const Params& params_) CV_OVERRIDE
    {
        params_.check();
        params = params_;
    }

    Params getParams() const CV_OVERRIDE { return params; }

protected:
    RollingShutterCamera camera;
    Params params;
};

}} // namespace cv::rsackermann

#endif // OPENCV_RSACKERMANN_SRC_STORAGE_HPP
