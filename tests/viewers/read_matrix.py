# Reads form-factor matrices with SciPy, and prints what it read as lines `ROW COLUMN VALUE`, from 0.
#
#   read_matrix.py FILE.npz|FILE.mtx
import sys

import scipy.io
import scipy.sparse

file = sys.argv[1]
read = scipy.io.mmread if file.endswith(".mtx") else scipy.sparse.load_npz
matrix = scipy.sparse.csr_matrix(read(file))
print("scipy", scipy.__version__, matrix.shape[0], matrix.shape[1], matrix.nnz)
for row in range(matrix.shape[0]):
    for k in range(matrix.indptr[row], matrix.indptr[row + 1]):
        print(row, matrix.indices[k], repr(float(matrix.data[k])))
