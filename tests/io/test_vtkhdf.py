# SPDX-License-Identifier: Apache-2.0
"""Snapshots and checkpoints as other programs read them: VTK 9.1's own reader, a version of ParaView 5.11's, and h5py.

Usage: test_vtkhdf.py WRITER, where WRITER FOLDER writes two frames and their checkpoints (write_sample_files.cpp).
"""
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import VTK_TRIANGLE, VTK_VERTEX
from vtkmodules.vtkIOHDF import vtkHDFReader

WRITER = sys.argv.pop()
COUNT = 100


def expected(frame):
    """Columns and their units, from the formulas of write_sample_files.cpp."""
    i = np.arange(COUNT)
    return {
        "position": (np.stack([i / 7.0, -i / 3.0, frame + i / 9.0], axis=1), "m"),
        "velocity": (np.stack([1.0 / (i + 1), np.zeros(COUNT), -2.0 * i], axis=1), "m/s"),
        "radius": (0.005 * (i + 1), "m"),
        "spatial_order": (2**53 + 1 - i, "1"),
    }


class Files(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        subprocess.run([WRITER, cls.folder.name], check=True)
        cls.files = [Path(cls.folder.name) / f"particles_000{frame}.vtkhdf" for frame in (0, 1)]

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def read_with_vtk(self, file):
        reader = vtkHDFReader()
        self.assertTrue(reader.CanReadFile(str(file)))
        reader.SetFileName(str(file))
        reader.Update()
        self.assertEqual(reader.GetErrorCode(), 0)
        return reader.GetOutput()

    def test_vtk_and_h5py_read_a_frame_without_particles(self):
        file = Path(self.folder.name) / "empty.vtkhdf"
        grid = self.read_with_vtk(file)
        self.assertEqual((grid.GetNumberOfPoints(), grid.GetNumberOfCells()), (0, 0))
        with h5py.File(file) as content:
            self.assertEqual(content["VTKHDF/Points"].shape, (0, 3))
            self.assertEqual(content["VTKHDF/PointData/identity"].shape, (0,))

    def test_vtk_sees_the_triangles_of_a_surface(self):
        for frame in (0, 1):
            grid = self.read_with_vtk(Path(self.folder.name) / f"walls_000{frame}.vtkhdf")
            self.assertEqual(grid.GetNumberOfPoints(), 4)
            self.assertEqual([grid.GetCellType(n) for n in range(grid.GetNumberOfCells())], [VTK_TRIANGLE] * 2)
            self.assertEqual([grid.GetCell(1).GetPointId(c) for c in range(3)], [0, 2, 3])
            cells = grid.GetCellData()
            np.testing.assert_array_equal(vtk_to_numpy(cells.GetArray("pressure")), [7, 8 + frame])
            np.testing.assert_array_equal(vtk_to_numpy(cells.GetArray("shear")), [[1, 2, 3], [4, 5, 6]])

    def test_vtk_sees_points_cells_and_columns(self):
        for frame, file in enumerate(self.files):
            grid = self.read_with_vtk(file)
            self.assertEqual(grid.GetClassName(), "vtkUnstructuredGrid")
            self.assertEqual(grid.GetNumberOfPoints(), COUNT)
            self.assertEqual(grid.GetNumberOfCells(), COUNT)
            for i in range(COUNT):
                self.assertEqual(grid.GetCellType(i), VTK_VERTEX)
                self.assertEqual(grid.GetCell(i).GetNumberOfPoints(), 1)
                self.assertEqual(grid.GetCell(i).GetPointId(0), i)
            columns = expected(frame)
            points = vtk_to_numpy(grid.GetPoints().GetData())
            self.assertEqual(points.dtype, np.float64)
            np.testing.assert_array_equal(points, columns.pop("position")[0])
            data = grid.GetPointData()
            self.assertEqual({data.GetArrayName(k) for k in range(data.GetNumberOfArrays())}, set(columns))
            for name, (values, _) in columns.items():
                found = vtk_to_numpy(data.GetArray(name))
                self.assertEqual(found.dtype, values.dtype, name)
                np.testing.assert_array_equal(found, values, name)

    def test_vtk_sees_the_time(self):
        for frame, file in enumerate(self.files):
            fields = self.read_with_vtk(file).GetFieldData()
            self.assertEqual({fields.GetArrayName(k) for k in range(fields.GetNumberOfArrays())},
                             {"time", "step", "TimeValue"})
            for name, value in (("time", 0.25 * frame), ("TimeValue", 0.25 * frame), ("step", 1000 * frame)):
                self.assertEqual(fields.GetArray(name).GetNumberOfTuples(), 1)
                self.assertEqual(fields.GetArray(name).GetTuple1(0), value)

    def test_h5py_sees_values_and_units(self):
        for frame, file in enumerate(self.files):
            with h5py.File(file, "r") as opened:
                root = opened["VTKHDF"]
                self.assertEqual(root.attrs["Type"], b"UnstructuredGrid")
                np.testing.assert_array_equal(root.attrs["Version"], [1, 0])
                columns = expected(frame)
                self.assertEqual(set(root["PointData"]), set(columns) - {"position"})
                for name, (values, unit) in columns.items():
                    data = root["Points"] if name == "position" else root["PointData"][name]
                    self.assertEqual(data.attrs["units"].decode(), unit, name)
                    self.assertEqual(data.dtype, values.dtype, name)
                    np.testing.assert_array_equal(data[()], values, name)
                self.assertEqual(root["FieldData/time"][0], 0.25 * frame)
                self.assertEqual(root["FieldData/time"].attrs["units"], b"s")
                self.assertEqual(root["FieldData/step"][0], 1000 * frame)

    def test_vtk_and_h5py_see_the_cells_of_the_air(self):
        cells = np.arange(24)
        for frame in (0, 1):
            file = self.files[0].parent / f"air_000{frame}.vtkhdf"
            velocity = np.stack([cells, -2.0 * cells, np.full(24, frame)], axis=1)
            grid = self.read_with_vtk(file)
            self.assertEqual(grid.GetClassName(), "vtkImageData")
            self.assertEqual(grid.GetDimensions(), (4, 3, 2))  # centres of cells
            self.assertEqual(grid.GetOrigin(), (1.25, 2.125, 3.0625))
            self.assertEqual(grid.GetSpacing(), (0.5, 0.25, 0.125))
            data = grid.GetPointData()
            self.assertEqual({data.GetArrayName(k) for k in range(data.GetNumberOfArrays())}, {"velocity", "pressure"})
            np.testing.assert_array_equal(vtk_to_numpy(data.GetArray("velocity")), velocity)
            np.testing.assert_array_equal(vtk_to_numpy(data.GetArray("pressure")), 10.0 + cells)
            with h5py.File(file, "r") as opened:
                root = opened["VTKHDF"]
                self.assertEqual(root["PointData/velocity"].shape, (2, 3, 4, 3))
                self.assertEqual(root["PointData/velocity"].attrs["units"], b"m/s")
                self.assertEqual(root.attrs["time"], 0.25 * frame)
                np.testing.assert_array_equal(root["PointData/pressure"][()].ravel(), 10.0 + cells)

    def test_vtk_and_h5py_see_the_cells_of_a_section(self):
        cells = np.arange(24)
        file = self.files[0].parent / "section_0001.vtkhdf"
        grid = self.read_with_vtk(file)
        self.assertEqual(grid.GetDimensions(), (6, 2, 4))  # front and rear of the only layer
        self.assertEqual(grid.GetOrigin(), (1.25, 2.0, 3.0625))
        self.assertEqual(grid.GetSpacing(), (0.5, 0.25, 0.125))
        self.assertEqual(grid.GetNumberOfCells(), 5 * 1 * 3)
        data = grid.GetPointData()
        pressure = vtk_to_numpy(data.GetArray("pressure")).reshape(4, 2, 6)
        velocity = vtk_to_numpy(data.GetArray("velocity")).reshape(4, 2, 6, 3)
        for face in (0, 1):
            np.testing.assert_array_equal(pressure[:, face].ravel(), 10.0 + cells)
            np.testing.assert_array_equal(velocity[:, face].reshape(24, 3),
                                          np.stack([cells, -2.0 * cells, np.ones(24)], axis=1))
        with h5py.File(file, "r") as opened:
            np.testing.assert_array_equal(opened["VTKHDF"].attrs["cells"], [6, 1, 4])

    def test_h5py_sees_checkpoints(self):
        for frame, letter in enumerate("ab"):
            with h5py.File(self.files[0].parent / f"checkpoint_{letter}.h5", "r") as opened:
                self.assertEqual(opened.userblock_size, 512)
                self.assertEqual(opened["fingerprint"][()], b"f00d")
                self.assertEqual(opened["state/step"][()], 1000 * frame)
                np.testing.assert_array_equal(opened["state/position"][()], expected(frame)["position"][0])
                self.assertEqual(opened["state/position"].attrs["units"], b"m")


if __name__ == "__main__":
    unittest.main()
