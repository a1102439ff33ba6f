// Words of places and speeds in the page.
import assert from "node:assert/strict";
import { test } from "node:test";
import { measured } from "../page/words.js";

test("what is measured at a coordinate has the file's unit, on whatever scale it is drawn", () => {
  assert.equal(measured(20, "km", 4), "20 km");
  assert.equal(measured(-20, "-25 hPa", 4), "500 hPa");
  assert.equal(measured(3, "2000 m", 4), "6000 m");
  assert.equal(measured(-4, "-0.5 lg(re 1 hPa)", 4), "100 hPa");
  assert.equal(measured(2, "", 4), "2");
});
