-- Sign-ins by OpenID Connect that are under way; the state is stored as a hash only, and goes when it is used.
CREATE TABLE sign_ins (
    state_hash TEXT PRIMARY KEY,
    -- The word of the configuration.
    provider   TEXT NOT NULL,
    nonce      TEXT NOT NULL,
    verifier   TEXT NOT NULL,
    -- The homework to go on with.
    homework   TEXT,
    expires_at BIGINT NOT NULL
);
