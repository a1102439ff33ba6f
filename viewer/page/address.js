// The address bar keeps what is seen: #n=50&at=x,y&zoom=2&seed=1&show=arrows,coast&page=dark

/** @returns {Record<string, string>} */
export function readAddress() {
  return Object.fromEntries(new URLSearchParams(location.hash.slice(1)));
}

let timer = 0;

export function writeAddress(values) {
  clearTimeout(timer);
  timer = setTimeout(() => {
    const text = Object.entries(values).filter(([, v]) => v !== undefined && v !== "").map(([k, v]) => `${k}=${v}`).join("&");
    try {
      history.replaceState(null, "", `#${text}`);
    } catch {
      location.hash = text; // a page in a sandbox
    }
  }, 150);
}
