// Meshes with places in float, which STL and manifold-3d take alike.

/** Returns a sphere of 2 (rows - 1) columns triangles. */
export function sphere(rows, columns, [x, y, z], radius) {
    const places = [[x, y, z + radius], [x, y, z - radius]], triangles = [];
    const at = (row, column) => (row === 0 ? 0 : row === rows ? 1 : 2 + (row - 1) * columns + (column % columns));
    for (let row = 1; row < rows; row++)
        for (let column = 0; column < columns; column++) {
            const tilt = (Math.PI * row) / rows, turn = (2 * Math.PI * column) / columns, flat = radius * Math.sin(tilt);
            places.push([x + flat * Math.cos(turn), y + flat * Math.sin(turn), z + radius * Math.cos(tilt)]);
        }
    for (let row = 0; row < rows; row++)
        for (let column = 0; column < columns; column++) {
            if (row > 0) triangles.push([at(row, column), at(row + 1, column), at(row, column + 1)]);
            if (row < rows - 1) triangles.push([at(row, column + 1), at(row + 1, column), at(row + 1, column + 1)]);
        }
    return { places: Float32Array.from(places.flat()), triangles: Uint32Array.from(triangles.flat()) };
}

/** Returns the bytes of a binary STL. */
export function stl({ places, triangles }) {
    const count = triangles.length / 3, bytes = Buffer.alloc(84 + 50 * count);
    bytes.writeUInt32LE(count, 80);
    for (let t = 0; t < count; t++)
        for (let corner = 0; corner < 3; corner++)
            for (let axis = 0; axis < 3; axis++)
                bytes.writeFloatLE(places[3 * triangles[3 * t + corner] + axis], 84 + 50 * t + 12 + 12 * corner + 4 * axis);
    return bytes;
}

/** Returns a solid of manifold-3d. */
export function solid({ Manifold, Mesh }, { places, triangles }) {
    return new Manifold(new Mesh({ numProp: 3, vertProperties: places, triVerts: triangles }));
}

/** Returns the mesh of a solid, with places in float. */
export function mesh(made) {
    const { numProp, vertProperties, triVerts, numVert } = made.getMesh();
    const places = new Float32Array(3 * numVert);
    for (let i = 0; i < numVert; i++) for (let axis = 0; axis < 3; axis++) places[3 * i + axis] = vertProperties[numProp * i + axis];
    return { places, triangles: Uint32Array.from(triVerts) };
}
